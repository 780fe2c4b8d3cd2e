// SPDX-License-Identifier: GPL-3.0-or-later

// The masses of particles, for sums over them. A policy, so that sums over equal spheres need no
// multiplication.
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/mixture.hpp"
#include "engine/particles/particle.hpp"

namespace haff::engine {

struct EqualMasses {
  static constexpr double of(const Particle&) { return 1; }
  static constexpr double of(std::uint32_t /*id*/) { return 1; }
  static double of_all(std::size_t particles) { return static_cast<double>(particles); }
};

struct MixedMasses {
  double of(const Particle& p) const { return of(p.id); }
  double of(std::uint32_t id) const { return mixture.mass_of(id); }
  double of_all(std::size_t particles) const {
    return mixture.first + static_cast<double>(particles - mixture.first) * mixture.mass;
  }

  Mixture mixture;
};

}  // namespace haff::engine
