// How the box is divided among threads: slabs of whole layers of bricks, and zones around the
// borders between them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/queue/event.hpp"
#include "engine/search/bricks.hpp"

namespace haff::engine {

// A range of layers that one thread may read, and the cells in it whose particles may have events
// there. Such an event reads only bricks of the territory, and it writes neither to the first nor
// to the last of its layers: so an event at a border reads nothing that an event inside could have
// written.
class Territory {
 public:
  Territory() = default;  // the whole box
  Territory(const Bricks& bricks, std::uint32_t first_layer, std::uint32_t layers)
      : axis_(bricks.last_axis()),
        cells_(2 * bricks.layers()),
        first_((2 * first_layer + 2) % cells_),
        count_(2 * layers - 4),
        first_layer_(first_layer),
        layers_(layers) {}

  bool holds(Cell cell) const {
    const std::uint32_t from_first = cell[axis_] - first_;
    return from_first + (from_first >> 31) * cells_ < count_;
  }
  bool holds_layer(std::uint32_t layer) const {
    const std::uint32_t from_first = layer - first_layer_;
    return from_first + (from_first >> 31) * (cells_ / 2) < layers_;
  }

 private:
  unsigned axis_ = 0;
  std::uint32_t cells_ = 0;
  std::uint32_t first_ = 0;
  std::uint32_t count_ = 1024;
  std::uint32_t first_layer_ = 0;
  std::uint32_t layers_ = 512;
};

class Slabs {
 public:
  // Fewer layers do not make a slab.
  static constexpr std::uint32_t fewest_layers = 4;
  // The number of slabs that fit, at most `wanted`.
  static unsigned most(const Bricks& bricks, unsigned wanted);

  // Divides the box so that every slab holds about the same number of particles. `events` say in
  // which cells they are.
  void divide(const Bricks& bricks, std::span<const Event> events, unsigned slabs);

  const Territory& slab(unsigned k) const { return slabs_[k]; }
  const Territory& zone(unsigned k) const { return zones_[k]; }  // between slabs k - 1 and k
  unsigned slab_of_layer(std::uint32_t layer) const { return slab_of_layer_[layer]; }
  unsigned zone_of_layer(std::uint32_t layer) const { return zone_of_layer_[layer]; }

 private:
  std::vector<Territory> slabs_;
  std::vector<Territory> zones_;
  std::vector<std::uint8_t> slab_of_layer_;
  std::vector<std::uint8_t> zone_of_layer_;
};

}  // namespace haff::engine
