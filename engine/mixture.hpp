// SPDX-License-Identifier: GPL-3.0-or-later

// A binary mixture: spheres, or disks, of two diameters and masses.
//
// Species 1 is the larger one and defines the units of length and mass; species 2 has the diameter
// diameter_ratio <= 1 and the mass mass_ratio. The species of a particle follows from its id, so no
// record holds it. The kinetic energy is m v^2 / 2; the temperature is <m v^2> / d, averaged over
// all particles, or over one species for the temperature of that species.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "state.hpp"

namespace haff::engine {

struct Mixture {
  std::uint32_t first = 0;  // the number of particles of species 1: those with the smallest ids
  double diameter = 1;      // of species 2 [sigma_1]
  double mass = 1;          // of species 2 [m_1]

  bool is_second(std::uint32_t id) const { return id >= first; }
  double diameter_of(std::uint32_t id) const { return is_second(id) ? diameter : 1; }
  double mass_of(std::uint32_t id) const { return is_second(id) ? mass : 1; }

  double contact_distance(std::uint32_t a, std::uint32_t b) const {
    return 0.5 * (diameter_of(a) + diameter_of(b));
  }

  bool operator==(const Mixture&) const = default;
};

// The mixture with the parameters fraction (of species 2), diameter_ratio and mass_ratio. Throws
// std::invalid_argument if one is missing or out of range, or if a species has no particle.
Mixture mixture_of(const std::map<std::string, double>& parameters, std::uint32_t particles);

// The mixture that a state records in its memory, or nothing if it is not a mixture; note() records
// it.
std::optional<Mixture> mixture_in(const State& state);
void note(const Mixture& mixture, State& state);

// Boltzmann's collision rate in d dimensions at given n and T, relative to that of species 1 alone.
double relative_rate(const Mixture& mixture, int d, std::uint32_t particles);

}  // namespace haff::engine
