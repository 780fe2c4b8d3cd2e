// SPDX-License-Identifier: GPL-3.0-or-later

#include "engine/search/bricks.hpp"

#include <algorithm>
#include <stdexcept>

namespace haff::engine {

Bricks::Bricks(const Box& box, std::uint32_t particles) : side_(box.side), inverse_(box.inverse) {
  if (particles > particle_in(particle_bits))
    throw std::length_error("the engine holds at most 2^28 - 1 particles");
  cells_ = cells_along(box, particles);
  const std::uint32_t bricks = cells_ / 2;
  cell_side_ = box.side / cells_;
  const std::uint32_t layers = box.d == 2 ? 1 : bricks;
  for (std::uint32_t axis = 0, stride = slots; axis < 3; ++axis, stride *= bricks) {
    const std::uint32_t count = axis == 2 ? layers : bricks;
    for (std::uint32_t c = 0; c < 2 * count; ++c) {
      const std::uint32_t brick = c / 2;
      const std::uint32_t next = (brick + (c % 2 == 1 ? 1 : count - 1)) % count;
      shares_[axis].push_back({brick * stride, next * stride});
    }
  }
  for (std::uint32_t n = 0; n < 8; ++n) care_around_[n].fill(care_around(n));
  for (std::uint32_t axis = 0; axis < 3; ++axis)
    for (std::uint32_t k = 0; k < 4; ++k) care_beyond_[axis][k].fill(care_beyond(axis, k));
  last_axis_ = box.d == 2 ? 1 : 2;
  layers_ = bricks;
  in_layer_ = (box.d == 2 ? bricks : bricks * bricks) * slots;
  overflow_.resize(layers_);
  lines_.resize(std::size_t{bricks} * bricks * layers);
  clear();
}

std::uint32_t Bricks::cells_along(const Box& box, std::uint32_t particles) {
  const double own = smallest_occupancy * box.volume() / particles;
  const double cell = std::max(smallest_cell, box.d == 2 ? std::sqrt(own) : std::cbrt(own));
  // At least two bricks along an axis; with one, the two neighbours of a brick would be the same.
  return 2 * static_cast<std::uint32_t>(
                 std::clamp(box.side / (2 * cell), 2.0, static_cast<double>(most_cells / 2)));
}

void Bricks::clear_layers(std::uint32_t begin, std::uint32_t end) {
  const std::uint32_t in_layer = in_layer_ / slots;
  std::fill(lines_.begin() + std::ptrdiff_t{begin} * in_layer,
            lines_.begin() + std::ptrdiff_t{end} * in_layer, Line{});
  for (std::uint32_t layer = begin; layer < end; ++layer) overflow_[layer].clear();
}

Cell Bricks::locate(const Vector& position) const {
  Cell cell{0};
  for (unsigned axis = 0; axis < 3; ++axis) {
    const double at = std::clamp(position[axis] * inverse_ * cells_, 0.0, cells_ - 1.0);
    cell.set(axis, static_cast<std::uint32_t>(at));
  }
  return cell;
}

void Bricks::insert(std::uint32_t particle, Cell cell) {
  const std::uint32_t brick = brick_of(cell);
  auto& slot = lines_[brick / slots].slot;
  if (slot.back() == 0)
    slot[taken(slot)] = entry(particle, cell);
  else
    overflow_[brick / in_layer_][brick].push_back(entry(particle, cell));
}

void Bricks::remove(std::uint32_t particle, Cell cell) {
  const std::uint32_t brick = brick_of(cell);
  const std::uint32_t gone = entry(particle, cell);
  auto& slot = lines_[brick / slots].slot;
  auto hole = std::find(slot.begin(), slot.end(), gone);
  auto& layer = overflow_[brick / in_layer_];
  if (const auto extra = layer.find(brick); extra != layer.end()) {
    auto& more = extra->second;
    (hole != slot.end() ? *hole : *std::find(more.begin(), more.end(), gone)) = more.back();
    more.pop_back();
    if (more.empty()) layer.erase(extra);
    return;
  }
  const std::size_t last = taken(slot) - 1;
  *hole = slot[last];
  slot[last] = 0;
}

const std::vector<std::uint32_t>& Bricks::overflow(std::uint32_t brick) const {
  static const std::vector<std::uint32_t> none;
  const auto& layer = overflow_[brick / in_layer_];
  const auto found = layer.find(brick);
  return found == layer.end() ? none : found->second;
}

}  // namespace haff::engine
