// SPDX-License-Identifier: GPL-3.0-or-later

// Rough spheres against M. Huthmann and A. Zippelius, Phys. Rev. E 56, R6275 (1997): the final
// ratio of rotational to translational temperature in a cooling gas, and the approach to it.
#include "analysis/theory/rough_spheres.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "analysis/observables/moments.hpp"
#include "engine/initial.hpp"
#include "engine/simulation.hpp"

using namespace haff;

namespace {

constexpr std::uint32_t particles = 20'000;

engine::Simulation rough_gas(double n, double e, const analysis::Roughness& roughness) {
  engine::Simulation melting({.restitution = 1},
                             engine::initial_state(n, particles, 1, roughness.d));
  melting.run_to(engine::collisions_at(20, particles));
  return {{.restitution = e,
           .effects = {{"roughness", {{"beta", roughness.beta}, {"q", roughness.q}}}}},
          engine::restarted(melting.state())};
}

analysis::RoughTemperatures measured(const engine::Simulation& gas, int d = 3) {
  return {
      .translation =
          std::ldexp(analysis::moments(gas.velocities(), d).temperature, -2 * gas.exponent()),
      .rotation = std::ldexp(*gas.rotational_energy() * 2 / (d == 2 ? 1 : 3), -2 * gas.exponent())};
}

}  // namespace

TEST_CASE("rough spheres approach the ratio of temperatures of Huthmann and Zippelius") {
  // A ratio is known to sqrt(4 / (3 N)) = 0.8 % at one time, and the mean of ten a collision apart
  // to some 0.5 %. The theory assumes Gaussian velocities and spins. Deviations from this matter
  // "for medium and small roughness" (A. Santos, G. M. Kremer and M. dos Santos, arXiv:1009.6180):
  // as measured, by 8 % at e = 0.8, beta = 0, and by less than 3 % for rougher spheres. Gases of
  // smaller beta reach their ratio only after many more collisions.
  for (const double e : {0.8, 0.95})
    for (const double beta : {0.0, 0.5, 0.9}) {
      const double tolerance = beta < 0.5 ? 0.12 : 0.05;
      CAPTURE(e);
      CAPTURE(beta);
      auto gas = rough_gas(0.05, e, {.beta = beta, .q = 0.4});
      double ratio = 0;
      for (double tau = 31; tau <= 40; ++tau) {
        gas.run_to(engine::collisions_at(tau, particles));
        const auto now = measured(gas);
        ratio += now.rotation / now.translation / 10;
      }
      const double theory = analysis::rough_temperature_ratio(e, {.beta = beta, .q = 0.4});
      MESSAGE("e = ", e, ", beta = ", beta, ": R/T = ", ratio, ", theory ", theory);
      CHECK(std::abs(ratio / theory - 1) < tolerance);
    }
}

TEST_CASE("rough spheres: both temperatures follow their equations") {
  // A temperature of 20 000 particles is known to sqrt(2 / (3 N)) = 0.6 %. T is measured within 1 %
  // of theory, and R, which depends more on the neglected correlation of velocities and spins,
  // within 3 %.
  const analysis::Roughness roughness{.beta = 0.5, .q = 0.4};
  auto gas = rough_gas(0.05, 0.9, roughness);
  for (const double tau : {0.5, 1.0, 2.0, 5.0}) {
    gas.run_to(engine::collisions_at(tau, particles));
    const auto now = measured(gas);
    const auto theory =
        analysis::rough_temperatures(tau, 0.9, roughness, {.translation = 2.0 / 3, .rotation = 0});
    MESSAGE("tau = ", tau, ": T ", now.translation, " theory ", theory.translation, ", R ",
            now.rotation, " theory ", theory.rotation);
    CHECK(now.translation == doctest::Approx(theory.translation).epsilon(0.02));
    CHECK(now.rotation == doctest::Approx(theory.rotation).epsilon(0.05));
  }
}

TEST_CASE("rough disks approach the ratio of temperatures of Huthmann and Zippelius") {
  // A ratio is known to sqrt(3 / N) = 1.2 % at one time, and the mean of five to some 0.8 %; as for
  // spheres, the theory assumes Gaussian velocities and spins. In two dimensions vortices soon
  // grow, whose energy is that of translation alone: at n = 0.05 the ratio is 5 % too small at
  // tau = 15 and 15 % at tau = 35. Hence the gas is dilute, and is measured early.
  for (const double beta : {0.0, 0.5, 0.9}) {
    const double tolerance = beta < 0.5 ? 0.08 : 0.05;
    const analysis::Roughness disks{.beta = beta, .q = 0.5, .d = 2};
    CAPTURE(beta);
    auto gas = rough_gas(0.01, 0.9, disks);
    double ratio = 0;
    for (double tau = 16; tau <= 20; ++tau) {
      gas.run_to(engine::collisions_at(tau, particles));
      const auto now = measured(gas, 2);
      ratio += now.rotation / now.translation / 5;
    }
    const double theory = analysis::rough_temperature_ratio(0.9, disks);
    MESSAGE("d = 2, e = 0.9, beta = ", beta, ": R/T = ", ratio, ", theory ", theory);
    CHECK(std::abs(ratio / theory - 1) < tolerance);
  }
}
