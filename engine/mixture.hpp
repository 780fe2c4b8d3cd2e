// A binary mixture: spheres, or disks, of two diameters and masses.
//
// Species 1 is the larger one, and gives the units of length and mass; species 2 has diameter
// diameter_ratio <= 1 and mass mass_ratio. Which species a particle is of follows from its id, so
// nobody carries it. Energies are m v^2 / 2; the temperature of all is (m/d) <v^2> averaged over
// all particles, that of a species the same over its own.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "engine/state.hpp"

namespace haff::engine {

struct Mixture {
  std::uint32_t first = 0;  // so many particles, those with the smallest ids, are of species 1
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

// From its parameters fraction (of species 2), diameter_ratio and mass_ratio. Throws
// std::invalid_argument if one is missing or out of range, or a species has no particle.
Mixture mixture_of(const std::map<std::string, double>& parameters, std::uint32_t particles);

// A state of a mixture says so in its memory.
std::optional<Mixture> mixture_in(const State& state);
void note(const Mixture& mixture, State& state);

// Boltzmann's collision rate in d dimensions at given n and T, in units of that of species 1 alone.
double relative_rate(const Mixture& mixture, int d, std::uint32_t particles);

}  // namespace haff::engine
