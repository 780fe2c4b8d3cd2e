#include "campaign/figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "analysis/energy_equation.hpp"
#include "campaign/text_table.hpp"

namespace haff::campaign {

std::string restitution_text(double e) {
  const std::string two = fmt::format("{:.2f}", e), more = fmt::format("{:.6g}", e);
  return more.size() > two.size() ? more : two;
}

std::string provenance(const std::vector<MeanSeries>& series) {
  // Restitutions that share particles and realizations are named together.
  std::map<std::pair<std::int64_t, std::int64_t>, std::string> groups;
  for (const MeanSeries& s : series) {
    std::string& list = groups[{s.particles, s.most_realizations()}];
    list += (list.empty() ? "e = " : ", ") + restitution_text(s.e);
  }
  std::string text = fmt::format("n = {:.2f}", series.front().n);
  for (const auto& [key, list] : groups) {
    const auto& [particles, realizations] = key;
    text += fmt::format("; {}: N = {}, {}", list, count_text(particles),
                        realizations == 1 ? "one realization"
                                          : fmt::format("mean of {} realizations", realizations));
  }
  return text + ".";
}

std::string error_note(const std::vector<MeanSeries>& series) {
  const bool any =
      std::ranges::any_of(series, [](const MeanSeries& s) { return s.most_realizations() > 1; });
  return any ? " Bars and bands: standard error of the mean." : "";
}

double homogeneous_stage(const MeanSeries& series) {
  constexpr double beyond = 1.5;
  const double crossover = analysis::energy_equation_tau_c({.e = series.e, .n = series.n});
  return std::min(series.tau.back(), 10 * std::ceil(beyond * crossover / 10));
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
