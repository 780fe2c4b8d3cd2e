// SPDX-License-Identifier: GPL-3.0-or-later

#include "engine/parallel/slabs.hpp"

#include <algorithm>

#include "engine/initial.hpp"
#include "engine/threads.hpp"

namespace haff::engine {
namespace {

// The fewest particles for a thread that makes a gas faster (threads.hpp).
constexpr std::uint32_t least_particles = 50'000;
constexpr std::uint32_t least_cells = 24;

// The times on several threads, such that two are as fast as measured (decisions/several-cores.md),
// in units of the time of an event on one thread: for an event in a slab and in a zone, and for the
// merging of sums; and the busiest thread's share in units of an even share.
constexpr double slab_event = 1.17;
constexpr double zone_event = 1.4;
constexpr double imbalance = 1.03;
constexpr double merging = 0.02;
// A zone has as many events as this many layers of cells.
constexpr double zone_layers = 4.7;

// The layers of cells on either side of a border that belong to its zone, if the slabs have room
// for them. Within a window, the events that have to wait at a border spread by less than a cell.
constexpr std::uint32_t widest_zone = 14;

}  // namespace

unsigned useful_threads(std::uint32_t particles, double n, int d) {
  if (particles < 2 * least_particles) return 1;
  const Box box(box_side(n, particles, d), d);
  if (!Bricks::fits(box)) return 1;
  const std::uint32_t slabs =
      std::min(particles / least_particles, Bricks::cells_along(box, particles) / least_cells);
  return std::clamp(slabs, 1u, 255u);
}

double expected_speed_up(unsigned threads, std::uint32_t particles, double n, int d) {
  if (threads <= 1) return 1;
  const double cells = Bricks::cells_along(Box(box_side(n, particles, d), d), particles);
  const double in_zones = std::min(1.0, zone_layers * threads / cells);
  const double event = slab_event + (zone_event - slab_event) * in_zones;
  return 1 / (event * imbalance / threads + merging);
}

unsigned Slabs::most(const Bricks& bricks, unsigned wanted) {
  return std::max(1u, std::min({wanted, bricks.cells() / fewest_cells, 255u}));
}

void Slabs::divide(const Bricks& bricks, std::span<const std::uint32_t> work, unsigned slabs) {
  axis_ = bricks.last_axis();
  const std::uint32_t cells = bricks.cells();
  std::vector<std::uint64_t> below(cells + 1);  // work below each layer
  for (std::uint32_t layer = 0; layer < cells; ++layer)
    below[layer + 1] = below[layer] + work[layer];

  std::vector<std::uint32_t> first;  // layer of each slab
  for (unsigned k = 0; k < slabs; ++k) {
    const std::uint64_t share = below.back() * k / slabs;
    auto layer = static_cast<std::uint32_t>(std::lower_bound(below.begin(), below.end(), share) -
                                            below.begin());
    if (layer > 0 && share - below[layer - 1] < below[layer] - share) --layer;
    // This leaves room for the slabs before and after.
    first.push_back(std::clamp(layer, k == 0 ? 0 : first.back() + fewest_cells,
                               cells - (slabs - k) * fewest_cells));
  }
  first.front() = 0;
  first.push_back(cells);

  std::uint32_t thinnest = cells;
  for (unsigned k = 0; k < slabs; ++k) thinnest = std::min(thinnest, first[k + 1] - first[k]);
  const std::uint32_t zone_cells = std::min(widest_zone, thinnest / 2);

  slabs_.clear();
  zones_.clear();
  slab_of_.assign(cells, 0);
  zone_of_.assign(cells, 0);
  for (unsigned k = 0; k < slabs; ++k) {
    slabs_.emplace_back(bricks, first[k], first[k + 1] - first[k], zone_cells);
    zones_.emplace_back(bricks, first[k], zone_cells);
    const std::uint32_t middle = (first[k] + first[k + 1]) / 2;
    for (std::uint32_t layer = first[k]; layer < first[k + 1]; ++layer) {
      slab_of_[layer] = static_cast<std::uint8_t>(k);
      zone_of_[layer] = static_cast<std::uint8_t>(layer < middle ? k : (k + 1) % slabs);
    }
  }
}

}  // namespace haff::engine
