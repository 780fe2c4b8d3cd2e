// SPDX-License-Identifier: GPL-3.0-or-later

// Differences of gases whose random errors are partly the same.
#include "campaign/accuracy/differences.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "support/synthetic_store.hpp"

using namespace haff::campaign;
using doctest::Approx;

namespace {

constexpr Quantity a2{.measure = Measure::a2, .from = 5, .to = 15};

// a_2 = mean + a random part that depends on the seed but not on e + another random part.
FinishedSeries gas(double e, double mean, double common, double own,
                   std::uint32_t particles = 1000) {
  FinishedSeries series{
      .job = {.e = e, .n = 0.4, .particles = particles, .observables = {"laguerre"}}, .runs = {}};
  for (std::uint64_t seed = 1; seed <= 64; ++seed) {
    haff::tests::Normal shared(seed),
        private_part(seed * 1000 + static_cast<std::uint64_t>(100 * e));
    FinishedRun run{.seed = seed, .tau_max = 15};
    const double value = mean + common * shared() + own * private_part();
    for (int tau = 0; tau <= 15; ++tau)
      run.samples.push_back({.tau = static_cast<double>(tau), .a2 = value});
    series.runs.push_back(run);
  }
  return series;
}

}  // namespace

TEST_CASE("differences: the common part of two gases is not in the error of their difference") {
  const auto all =
      paired_differences({gas(0.8, -0.03, 0.02, 0.002), gas(0.9, -0.01, 0.02, 0.002)}, {a2});
  REQUIRE(all.size() == 1);
  const Difference& each = all.front();
  CHECK(each.difference.pairs == 64);
  CHECK(each.job.e == 0.9);
  CHECK(each.reference.e == 0.8);
  // The errors of 64 normal values are known to 9 %; four times that is allowed.
  CHECK(each.difference.error == Approx(0.002 * std::sqrt(2) / 8).epsilon(0.36));
  CHECK(each.difference.independent == Approx(0.02 * std::sqrt(2) / 8).epsilon(0.36));
  CHECK(std::abs(each.difference.value - 0.02) < 4 * each.difference.error);
}

TEST_CASE("differences: only gases that started from the same states are compared") {
  CHECK(paired_differences({gas(0.8, 0, 1, 0), gas(0.9, 0, 1, 0, 2000)}, {a2}).empty());
  FinishedSeries other = gas(0.9, 0, 1, 0);
  for (FinishedRun& run : other.runs) run.seed += 1000;
  CHECK(paired_differences({gas(0.8, 0, 1, 0), other}, {a2}).empty());
}
