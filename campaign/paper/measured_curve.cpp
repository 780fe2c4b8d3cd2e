// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/paper/measured_curve.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/theory/energy_equation.hpp"
#include "campaign/base/text/number_text.hpp"

namespace haff::campaign {

double homogeneous_stage(const MeanSeries& series) {
  constexpr double beyond = 1.5;
  const double crossover = analysis::energy_equation_tau_c({.e = series.e, .n = series.n});
  // Where most realizations have ended the mean leaps to that of the few that go on.
  std::size_t last = series.tau.size() - 1;
  while (last > 0 && 2 * series.realizations[last] < series.most_realizations()) --last;
  return std::min(series.tau[last], 10 * std::ceil(beyond * crossover / 10));
}

Curve until(double end, Curve curve) {
  const auto shown = std::ranges::upper_bound(curve.x, end) - curve.x.begin();
  const auto size = static_cast<std::size_t>(shown);
  curve.x.resize(size);
  curve.y.resize(size);
  if (!curve.error.empty()) curve.error.resize(size);
  if (!curve.realizations.empty()) curve.realizations.resize(size);
  return curve;
}

Curve measured_curve(const MeanSeries& series) {
  Curve curve;
  curve.name = "e = " + restitution_text(series.e);
  curve.legend = "{/:Italic e} = " + restitution_text(series.e);
  curve.source = Source::measured;
  curve.e = series.e;
  curve.n = series.n;
  curve.particles = series.particles;
  curve.realizations = series.realizations;
  return curve;
}

}  // namespace haff::campaign
