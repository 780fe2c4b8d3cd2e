#include "engine/parallel/slabs.hpp"

#include <algorithm>

namespace haff::engine {

unsigned Slabs::most(const Bricks& bricks, unsigned wanted) {
  return std::max(1u, std::min({wanted, bricks.layers() / fewest_layers, 255u}));
}

void Slabs::divide(const Bricks& bricks, std::span<const Event> events, unsigned slabs) {
  const std::uint32_t layers = bricks.layers();
  std::vector<std::size_t> below(layers + 1);  // particles below each layer
  for (const Event& event : events) ++below[bricks.layer_of(event.cell) + 1];
  for (std::uint32_t layer = 0; layer < layers; ++layer) below[layer + 1] += below[layer];

  std::vector<std::uint32_t> first;  // layer of each slab
  for (unsigned k = 0; k < slabs; ++k) {
    const std::size_t share = events.size() * k / slabs;
    const auto layer = static_cast<std::uint32_t>(
        std::lower_bound(below.begin(), below.end(), share) - below.begin());
    // Room for the slabs before and after.
    first.push_back(std::clamp(layer, k == 0 ? 0 : first.back() + fewest_layers,
                               layers - (slabs - k) * fewest_layers));
  }
  first.front() = 0;
  first.push_back(layers);

  slabs_.clear();
  zones_.clear();
  slab_of_layer_.assign(layers, 0);
  zone_of_layer_.assign(layers, 0);
  const auto middle = [&](unsigned k) { return (first[k] + first[k + 1]) / 2; };
  for (unsigned k = 0; k < slabs; ++k) {
    slabs_.emplace_back(bricks, first[k], first[k + 1] - first[k]);
    for (std::uint32_t layer = first[k]; layer < first[k + 1]; ++layer) {
      slab_of_layer_[layer] = static_cast<std::uint8_t>(k);
      zone_of_layer_[layer] = static_cast<std::uint8_t>(layer < middle(k) ? k : (k + 1) % slabs);
    }
    const std::uint32_t from = middle(k == 0 ? slabs - 1 : k - 1);
    zones_.emplace_back(bricks, from, (middle(k) + layers - from) % layers);
  }
}

}  // namespace haff::engine
