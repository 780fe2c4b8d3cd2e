// SPDX-License-Identifier: GPL-3.0-or-later

// Statistics of collisions, counted in bins of equal width that begin at zero. Counts are whole
// numbers, so that the order of summation does not matter.
#pragma once

#include <array>
#include <cstdint>

namespace haff::engine {

struct CollisionCounts {
  static constexpr int bins_of_free_time = 100;
  static constexpr int bins_of_impact = 20;
  static constexpr int bins_of_normal_speed = 60;
  // The number of bins in a unit of free time, and in a unit of normal speed.
  static constexpr int free_time_resolution = 10;
  static constexpr int normal_speed_resolution = 10;

  // The last bin holds all longer free times, and all higher speeds.
  //   free_time     of a particle, since its previous collision, on the collision clock [collisions
  //                 per particle of the whole gas]. Flights that began before the observation are
  //                 not counted.
  //   impact        b^(d-1), 0 <= b <= 1, where b is the sine of the angle between the line of
  //                 centres and the relative velocity
  //   normal_speed  the speed of approach along the line of centres, times sqrt(mu/T), with the
  //                 reduced mass mu of the pair and the granular temperature T of the gas at that
  //                 moment
  std::array<std::int64_t, bins_of_free_time + 1> free_time = {};
  std::array<std::int64_t, bins_of_impact> impact = {};
  std::array<std::int64_t, bins_of_normal_speed + 1> normal_speed = {};

  bool operator==(const CollisionCounts&) const = default;
};

}  // namespace haff::engine
