// SPDX-License-Identifier: GPL-3.0-or-later

// The uncorrelated gas of rough spheres: limits, and the two forms in which its ratio is published.
#include "analysis/theory/rough_spheres.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>

#include "support/relative.hpp"

using haff::tests::off;
using namespace haff::analysis;
using doctest::Approx;

TEST_CASE("rough spheres: perfectly rough and elastic spheres share their energy equally") {
  for (const double q : {0.1, 0.4, 2.0 / 3}) {
    CHECK(rough_temperature_ratio(1, {1, q}) == Approx(1).epsilon(1e-14));
    const auto late = rough_temperatures(400, 1, {1, q}, {.translation = 1, .rotation = 0});
    CHECK(late.translation == Approx(0.5).epsilon(1e-12));
    CHECK(late.rotation == Approx(0.5).epsilon(1e-12));
  }
}

TEST_CASE("rough spheres: the ratio as Santos, Kremer and dos Santos write it") {
  for (const double e : {0.5, 0.8, 1.0})
    for (const double beta : {-0.9, -0.5, 0.0, 0.7, 1.0})
      for (const double q : {0.1, 0.4}) {
        const double h = (1 + q) * (1 + q) / (2 * q * (1 + beta) * (1 + beta)) *
                         (1 - e * e - (1 - beta * beta) * (1 - q) / (1 + q));
        CHECK(rough_temperature_ratio(e, {beta, q}) ==
              Approx(h + std::sqrt(1 + h * h)).epsilon(1e-9));
      }
}

TEST_CASE("rough spheres: the temperatures approach the ratio from either side") {
  for (const double beta : {-0.5, 0.5}) {
    const double ratio = rough_temperature_ratio(0.8, {beta, 0.4});
    for (const double rotation : {0.0, 10.0}) {
      const auto late = rough_temperatures(2000, 0.8, {beta, 0.4}, {1, rotation});
      CHECK(late.rotation / late.translation == Approx(ratio).epsilon(1e-9));
    }
  }
}

TEST_CASE("rough spheres: the temperatures obey their equations") {
  const double e = 0.7, beta = 0.3, q = 0.4, tau = 2, step = 1e-4;
  const double eta = q * (1 + beta) / (2 * (1 + q));
  const auto at = [&](double time) { return rough_temperatures(time, e, {beta, q}, {1, 0.2}); };
  const double rate = (at(tau + step).translation - at(tau - step).translation) / (2 * step);
  const double A = (1 - e * e) / 4 + eta * (1 - eta), B = eta * eta / q;
  CHECK(off(rate, -4.0 / 3 * (A * at(tau).translation - B * at(tau).rotation)) < 1e-6);
}

TEST_CASE("rough disks: the temperatures of all motions become equal if no energy is lost") {
  const auto late = rough_temperatures(400, 1, {1, 0.5, 2}, {.translation = 1, .rotation = 0});
  CHECK(late.translation == Approx(2.0 / 3).epsilon(1e-12));
  CHECK(late.rotation == Approx(2.0 / 3).epsilon(1e-12));
  CHECK(rough_temperature_ratio(1, {1, 0.5, 2}) == Approx(1).epsilon(1e-14));
}

TEST_CASE("rough disks: the temperatures obey their equations and approach the ratio") {
  const double e = 0.7, beta = 0.3, q = 0.5, tau = 2, step = 1e-4;
  const double eta = q * (1 + beta) / (2 * (1 + q));
  const Roughness disks{beta, q, 2};
  const auto at = [&](double time) { return rough_temperatures(time, e, disks, {1, 0.2}); };
  const auto [T, R] = at(tau);
  const double A = (1 - e * e) / 2 + eta * (1 - eta), B = eta * eta / q,
               C = eta / q * (1 - eta / q);
  const double translation = (at(tau + step).translation - at(tau - step).translation) / (2 * step);
  const double rotation = (at(tau + step).rotation - at(tau - step).rotation) / (2 * step);
  CHECK(off(translation, -(A * T - B * R)) < 1e-6);
  CHECK(off(rotation, -2 * (C * R - B * T)) < 1e-6);
  const auto late = at(500);
  CHECK(late.rotation / late.translation ==
        Approx(rough_temperature_ratio(e, disks)).epsilon(1e-9));
}

TEST_CASE("rough spheres: smooth spheres cool by Haff's law and keep their spins") {
  const auto later = rough_temperatures(3, 0.8, {-1, 0.4}, {1, 0.5});
  CHECK(later.translation == Approx(std::exp(-(1 - 0.64) / 3 * 3)).epsilon(1e-14));
  CHECK(later.rotation == Approx(0.5).epsilon(1e-14));
  CHECK(std::isinf(rough_temperature_ratio(0.8, {-1, 0.4})));
}
