// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/results/box.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/theory/enskog.hpp"
#include "analysis/theory/modes.hpp"
#include "campaign/base/text/number_text.hpp"
#include "engine/initial.hpp"

namespace haff::campaign {
namespace {

// Waves along the axes of a periodic box have lengths L/1, L/2, ...; the oblique ones between them
// change the fastest rate by little. Shorter waves than this grow in no box that fits into a
// machine.
constexpr int most_waves = 100'000;

double growth_rate(const analysis::Gas& gas, double k) {
  const analysis::ModeSpectrum spectrum = analysis::modes(gas, k);
  return std::max(spectrum.transverse, spectrum.longitudinal[0].real());
}

}  // namespace

std::optional<BoxReport> box_report(const schema::Job& job) {
  if (job.kind != schema::Kind::cooling || !job.e || *job.e >= 1 || !job.effects.none())
    return std::nullopt;
  const analysis::Gas gas{.e = *job.e, .n = job.n, .d = job.d};
  constexpr double full = 2 * std::numbers::pi;
  const analysis::Lengths length = analysis::lengths(gas);
  const analysis::InstabilityBounds bounds = analysis::instability_bounds(gas);

  BoxReport report;
  report.side = engine::box_side(job.n, job.particles, job.d);
  report.vortex_length = full * length.transverse;
  report.cluster_length = full * length.longitudinal;
  if (bounds.heat > 0) report.heat_length = full / bounds.heat;
  report.vortices_across = report.side / report.vortex_length;
  report.clusters_across = report.side / report.cluster_length;
  const double shortest = std::min(report.vortex_length, report.heat_length.value_or(INFINITY));
  report.keeps_haff = report.side < shortest;
  report.haff_particles = job.n * std::pow(shortest, job.d);
  if (report.keeps_haff) return report;

  const int waves = static_cast<int>(std::min<double>(most_waves, report.side / shortest));
  double fastest = 0;
  for (int wave = 1; wave <= waves; ++wave) {
    const double rate = growth_rate(gas, full * wave / report.side);
    if (rate <= fastest) {
      if (wave > 3) break;  // rates fall with k from here on
      continue;
    }
    fastest = rate;
    report.fastest_wave = report.side / wave;
    report.waves_across = wave;
  }
  if (fastest > 0) {
    report.fastest_rate = fastest;
    report.grown_tau = 1 / fastest;
  }
  return report;
}

std::string haff_warning(const schema::Job& job, const BoxReport& report) {
  if (!report.keeps_haff) return "";
  return fmt::format(
      "e = {}, n = {}, N = {}: the box is too small to leave Haff's law. No wave in it grows, so "
      "no "
      "tau_c is reached; that needs N > {}",
      number_text(job.e.value_or(1)), number_text(job.n), count_text(job.particles),
      count_text(std::lround(report.haff_particles)));
}

}  // namespace haff::campaign
