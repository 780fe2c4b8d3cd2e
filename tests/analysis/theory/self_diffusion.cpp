// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/theory/self_diffusion.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "analysis/theory/enskog.hpp"

using namespace haff::analysis;
using doctest::Approx;

TEST_CASE("self_diffusion: Chapman and Enskog's coefficient of spheres and disks") {
  const double n = 0.05, T = 0.7;
  const double spheres = 1.019 * 3 / (8 * n * contact_value(n)) * std::sqrt(T / std::numbers::pi);
  CHECK(self_diffusion_per_collision(n) * transport(n, T).collision_rate ==
        Approx(spheres).epsilon(1e-12));
  const double disks = 1 / (2 * n * contact_value(n, 2)) * std::sqrt(T / std::numbers::pi);
  CHECK(self_diffusion_per_collision(n, 2) * transport(n, T, 2).collision_rate ==
        Approx(disks).epsilon(1e-12));
}

TEST_CASE("self_diffusion: Enskog's D beside that of simulations") {
  const auto excess = [](double n) {
    return simulated_self_diffusion_per_collision(n) / self_diffusion_per_collision(n) - 1;
  };
  // The fit begins at the first Sonine approximation.
  CHECK(excess(1e-4) == Approx(1 / 1.019 - 1).epsilon(0.02));
  CHECK(excess(0.1) == Approx(0.024).epsilon(0.03));
  CHECK(excess(0.2) == Approx(0.073).epsilon(0.03));
  CHECK(excess(0.4) == Approx(0.174).epsilon(0.03));
  double most = 0;
  for (double n = 0.05; n < 0.9; n += 0.01) most = std::max(most, excess(n));
  CHECK(most == Approx(0.205).epsilon(0.03));
  CHECK(excess(0.78) > 0);
  CHECK(excess(0.80) < 0);
  CHECK_THROWS_AS(simulated_self_diffusion_per_collision(1.1), std::invalid_argument);
}

TEST_CASE("self_diffusion: D is the integral of the velocity autocorrelation") {
  // D/omega = T/omega^2 times the integral of the autocorrelation, in the first approximation.
  const double n = 0.05, rate = transport(n, 1).collision_rate;
  CHECK(self_diffusion_per_collision(n) / 1.019 == Approx(1.5 / (rate * rate)).epsilon(1e-12));
  CHECK(enskog_autocorrelation(3, 2) == Approx(std::exp(-3)));
}
