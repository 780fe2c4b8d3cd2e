// SPDX-License-Identifier: GPL-3.0-or-later

#include "engine/mixture.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "engine/support/parameters.hpp"

namespace haff::engine {
namespace {

constexpr const char* key = "mixture";  // {first, diameter, mass}

}  // namespace

Mixture mixture_of(const Parameters& parameters, std::uint32_t particles) {
  const double fraction = positive(parameters, "fraction");
  const Mixture mixture{.first = particles - static_cast<std::uint32_t>(
                                                 std::llround(std::min(fraction, 1.0) * particles)),
                        .diameter = positive(parameters, "diameter_ratio"),
                        .mass = positive(parameters, "mass_ratio")};
  if (mixture.diameter > 1)
    throw std::invalid_argument("the model needs diameter_ratio <= 1: species 1 is the larger");
  if (mixture.first == 0 || mixture.first == particles)
    throw std::invalid_argument("a mixture with so small a fraction needs more particles than " +
                                std::to_string(particles));
  return mixture;
}

// An invalid entry yields a mixture without species 1, which soundness.cpp refuses.
std::optional<Mixture> mixture_in(const State& state) {
  const auto found = state.memory.find(key);
  if (found == state.memory.end()) return std::nullopt;
  const std::vector<double>& numbers = found->second;
  if (numbers.size() != 3 || !(numbers[0] >= 0 && numbers[0] <= state.particles()))
    return Mixture{};
  return Mixture{
      .first = static_cast<std::uint32_t>(numbers[0]), .diameter = numbers[1], .mass = numbers[2]};
}

void note(const Mixture& mixture, State& state) {
  state.memory[key] = {static_cast<double>(mixture.first), mixture.diameter, mixture.mass};
}

double relative_rate(const Mixture& mixture, int d, std::uint32_t particles) {
  const double second = 1 - static_cast<double>(mixture.first) / particles;
  const double first = 1 - second;
  // The cross section: the area of a disk of radius sigma_ab, or its diameter in two dimensions.
  const auto target = [&](double contact) { return d == 2 ? contact : contact * contact; };
  return first * first +
         2 * first * second * target(0.5 * (1 + mixture.diameter)) *
             std::sqrt(0.5 * (1 + 1 / mixture.mass)) +
         second * second * target(mixture.diameter) / std::sqrt(mixture.mass);
}

}  // namespace haff::engine
