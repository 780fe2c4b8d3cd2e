// SPDX-License-Identifier: GPL-3.0-or-later

#include "engine/parallel/slabs.hpp"

#include <algorithm>

namespace haff::engine {
namespace {

// Cells on either side of a border that belong to its zone, if the slabs have room for them. What
// has to wait at a border spreads by less than a cell within a window.
constexpr std::uint32_t widest_zone = 14;

}  // namespace

unsigned Slabs::most(const Bricks& bricks, unsigned wanted) {
  return std::max(1u, std::min({wanted, bricks.layers() / fewest_layers, 255u}));
}

void Slabs::divide(const Bricks& bricks, std::span<const std::uint32_t> work, unsigned slabs) {
  const std::uint32_t layers = bricks.layers();
  std::vector<std::uint64_t> below(layers + 1);  // work below each layer
  for (std::uint32_t layer = 0; layer < layers; ++layer)
    below[layer + 1] = below[layer] + work[layer];

  std::vector<std::uint32_t> first;  // layer of each slab
  for (unsigned k = 0; k < slabs; ++k) {
    const std::uint64_t share = below.back() * k / slabs;
    auto layer = static_cast<std::uint32_t>(std::lower_bound(below.begin(), below.end(), share) -
                                            below.begin());
    if (layer > 0 && share - below[layer - 1] < below[layer] - share) --layer;
    // Room for the slabs before and after.
    first.push_back(std::clamp(layer, k == 0 ? 0 : first.back() + fewest_layers,
                               layers - (slabs - k) * fewest_layers));
  }
  first.front() = 0;
  first.push_back(layers);

  std::uint32_t thinnest = layers;
  for (unsigned k = 0; k < slabs; ++k) thinnest = std::min(thinnest, first[k + 1] - first[k]);
  const std::uint32_t zone_cells = std::min(widest_zone, thinnest);  // half of it

  slabs_.clear();
  zones_.clear();
  slab_of_layer_.assign(layers, 0);
  zone_of_layer_.assign(layers, 0);
  for (unsigned k = 0; k < slabs; ++k) {
    slabs_.emplace_back(bricks, first[k], first[k + 1] - first[k], zone_cells);
    zones_.emplace_back(bricks, first[k], zone_cells);
    const std::uint32_t middle = (first[k] + first[k + 1]) / 2;
    for (std::uint32_t layer = first[k]; layer < first[k + 1]; ++layer) {
      slab_of_layer_[layer] = static_cast<std::uint8_t>(k);
      zone_of_layer_[layer] = static_cast<std::uint8_t>(layer < middle ? k : (k + 1) % slabs);
    }
  }
}

}  // namespace haff::engine
