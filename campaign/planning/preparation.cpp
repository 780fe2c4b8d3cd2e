// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/planning/preparation.hpp"

#include <fmt/format.h>

#include <cstdint>

#include "campaign/base/text/number_text.hpp"
#include "engine/initial.hpp"

namespace haff::campaign {
namespace {

// The part of the volume up to which random spheres (disks) have been grown without jamming; random
// close packing is 0.64 (0.84).
constexpr double densest_growth(int d) {
  return d == 2 ? 0.82 : 0.63;
}

// The nearest number of particles that a lattice holds at this density, upwards or downwards.
std::optional<std::uint32_t> nearest(const schema::Preparation& gas, int step) {
  constexpr std::int64_t farthest = 1'000'000;
  const std::int64_t smallest = gas.d == 2 ? 4 : 8;  // a box of some two diameters
  for (std::int64_t k = 1; k < farthest; ++k) {
    const std::int64_t particles = gas.particles + step * k;
    if (particles < smallest || particles > 0xffffffff) return std::nullopt;
    const auto count = static_cast<std::uint32_t>(particles);
    if (engine::begins_on_lattice(gas.n, count, gas.d)) return count;
  }
  return std::nullopt;
}

std::string expected(const schema::Preparation& gas) {
  if (gas.is_mixed) return "expected a smaller n";
  const auto below = nearest(gas, -1), above = nearest(gas, 1);
  std::string counts;
  if (below) counts = fmt::format("N = {}", *below);
  if (above) counts += fmt::format("{}{}", below ? " or " : "N = ", *above);
  return counts.empty() ? "expected a smaller n"
                        : fmt::format("expected {}, which fill a lattice, or a smaller n", counts);
}

}  // namespace

std::optional<std::string> why_not_prepared(const schema::Preparation& gas) {
  if (!gas.on_lattice && gas.packing <= densest_growth(gas.d)) return std::nullopt;
  if (engine::begins_on_lattice(gas.n, gas.particles, gas.d)) return std::nullopt;
  if (gas.on_lattice)
    return fmt::format("{} at n = {} are no crystal: on a lattice they would overlap; {}",
                       gas.d == 2 ? "disks" : "spheres", number_text(gas.n), expected(gas));
  return fmt::format(
      "{} at n = {} fill {:.2f} of their box: no lattice holds them, and {} that "
      "grow from random points jam before; {}",
      gas.d == 2 ? "disks" : "spheres", number_text(gas.n), gas.packing,
      gas.d == 2 ? "disks" : "spheres", expected(gas));
}

}  // namespace haff::campaign
