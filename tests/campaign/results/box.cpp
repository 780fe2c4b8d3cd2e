// SPDX-License-Identifier: GPL-3.0-or-later

// The instabilities that fit into a box by linear theory, against an independent calculation.
#include "campaign/results/box.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

using namespace haff;
using campaign::box_report;
using campaign::BoxReport;
using campaign::haff_warning;
using doctest::Approx;

namespace {

schema::Job cooling(double e, std::uint32_t particles) {
  return {.e = e, .n = 0.4, .particles = particles, .seed = 1};
}

}  // namespace

TEST_CASE("box: below N = 563 (e = 0.8) and 1468 (e = 0.9) a gas of n = 0.4 obeys Haff's law") {
  for (const auto& each : {std::pair{0.8, 563.0}, std::pair{0.9, 1468.0}}) {
    const double e = each.first, particles = each.second;
    CAPTURE(e);
    const BoxReport small =
        box_report(cooling(e, static_cast<std::uint32_t>(particles) - 1)).value();
    const BoxReport large =
        box_report(cooling(e, static_cast<std::uint32_t>(particles) + 1)).value();
    CHECK(small.keeps_haff);
    CHECK_FALSE(large.keeps_haff);
    CHECK(small.haff_particles == Approx(particles).epsilon(1e-3));
    CHECK_FALSE(small.fastest_rate);
    CHECK(haff_warning(cooling(e, 500), *box_report(cooling(e, 500))).find("too small") !=
          std::string::npos);
    CHECK(haff_warning(cooling(e, 5000), *box_report(cooling(e, 5000))).empty());
  }
}

TEST_CASE(
    "box: lengths are 2 pi times the correlation lengths, and the longest waves grow fastest") {
  // xi_perp = 1.7837 and xi_par = 6.0963 at e = 0.8, n = 0.4, to their four digits.
  constexpr double full = 2 * std::numbers::pi;
  const BoxReport report = box_report(cooling(0.8, 600'000)).value();
  CHECK(report.side == Approx(std::cbrt(1.5e6)).epsilon(1e-12));
  CHECK(report.vortex_length == Approx(full * 1.7837).epsilon(1e-4));
  CHECK(report.cluster_length == Approx(full * 6.0963).epsilon(1e-4));
  CHECK(report.vortices_across == Approx(report.side / (full * 1.7837)).epsilon(1e-4));
  CHECK(report.waves_across.value() == 1);
  // The shear mode of wave number 2 pi / L: gamma_0 (1 - (xi_perp 2 pi / L)^2), gamma_0 = 0.06.
  CHECK(report.fastest_rate.value() >=
        0.06 * (1 - std::pow(full * 1.7837 / report.side, 2)) * 0.9999);
  CHECK(report.grown_tau.value() == Approx(1 / *report.fastest_rate).epsilon(1e-12));
}

TEST_CASE("box: gases that linear theory does not cover have no report") {
  schema::Job job = cooling(0.8, 1000);
  job.effects = R"({"shuffle":{"every":1.0}})";
  CHECK_FALSE(box_report(job));
  CHECK_FALSE(box_report(cooling(1, 1000)));
  CHECK_FALSE(box_report(equilibration_of(cooling(0.8, 1000))));
}
