// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/curves/answer/theory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "analysis/direct/table.hpp"
#include "campaign/curves/theory_lines.hpp"

namespace haff::campaign {
namespace {

// A direct simulation takes a second or so.
constexpr std::size_t most_simulations = 12;

constexpr int theory_points = 160;

std::vector<double> steps(double from, double to, int count) {
  std::vector<double> values;
  for (int i = 0; i <= count; ++i) values.push_back(from + (to - from) * i / count);
  return values;
}

// Our lines less theirs, where both have a line of the name.
std::vector<TheoryLine> subtracted(std::vector<TheoryLine> ours,
                                   const std::vector<TheoryLine>& theirs) {
  std::vector<TheoryLine> left;
  for (TheoryLine& line : ours) {
    const auto same = std::ranges::find(theirs, line.name, &TheoryLine::name);
    if (same == theirs.end()) continue;
    for (std::size_t i = 0; i < line.values.size(); ++i) {
      line.values[i] -= same->values[i];
      if (i < line.errors.size() && i < same->errors.size())
        line.errors[i] = std::hypot(line.errors[i], same->errors[i]);
    }
    left.push_back(std::move(line));
  }
  return left;
}

template <class Of>
std::vector<TheoryLine> theory_of(const Gas& gas, Of&& of) {
  auto lines = of(gas.job);
  return gas.reference ? subtracted(std::move(lines), of(*gas.reference)) : lines;
}

// A theory line with its x.
struct PlacedLine {
  TheoryLine line;
  std::vector<double> x;
};

// Without what lies beyond `last`: x increases.
void cut_after(PlacedLine& placed, double last) {
  const auto kept =
      static_cast<std::size_t>(std::ranges::upper_bound(placed.x, last) - placed.x.begin());
  placed.x.resize(kept);
  placed.line.values.resize(kept);
  if (!placed.line.errors.empty()) placed.line.errors.resize(kept);
}

// The tau by which both clocks of theory have passed a time; 0 where theory has none. A gas can be
// sampled at any moments, so their number says nothing of it.
double tau_after(double time, const schema::Job& job) {
  constexpr double farthest =
      1e6;  // no gas of ours comes so far, and a clock that turns NaN ends here
  for (double end = 1; end < farthest; end *= 2) {
    const auto tau = steps(0, end, theory_points);
    std::size_t passed = 0;
    for (const char* clock : {"temperature_haff", "temperature_energy_equation_non_gaussian"}) {
      const auto times = times_of({.name = clock, .legend = {}}, job, tau, Simulations::left_out);
      const auto here = std::ranges::lower_bound(times, time) - times.begin();
      if (!times.empty()) passed = std::max(passed, static_cast<std::size_t>(here));
    }
    if (passed < tau.size()) return tau[passed];
  }
  return farthest;
}

std::vector<PlacedLine> theory_along_run(const Topic& topic, const GasCurve& gas) {
  std::vector<PlacedLine> placed;
  if (topic.kind == Topic::Kind::profile) {
    const double tau = gas.scene.number("tau").value_or(0);
    std::vector<double> x;
    for (const CurvePoint& point : gas.points) x.push_back(point.x);
    if (x.size() > 1) x = steps(x.front(), x.back(), theory_points);
    for (TheoryLine& line : theory_of(gas.gases.front(), [&](const schema::Job& job) {
           return theory_of_profile(topic.y, job, tau, x);
         }))
      placed.push_back({std::move(line), x});
    return placed;
  }
  if (topic.x != "tau" && topic.x != "time") return placed;
  const schema::Job& job = gas.gases.front().job;
  const double last = gas.points.back().x;
  const auto tau = steps(0, topic.x == "time" ? tau_after(last, job) : last, theory_points);
  for (TheoryLine& line : theory_of(gas.gases.front(), [&](const schema::Job& each) {
         return theory_in_tau(topic.y, each, tau);
       })) {
    auto x = topic.x == "time" ? times_of(line, job, tau) : tau;
    if (x.empty()) continue;
    placed.push_back({std::move(line), std::move(x)});
    cut_after(placed.back(), last);
  }
  return placed;
}

// One theory value of each gas of a curve, or of like gases in between where it costs nothing.
std::vector<Gas> gases_between(const Topic& topic, const GasCurve& curve, bool is_dear,
                               std::vector<double>& x) {
  const bool is_parameter = topic.x == "e" || topic.x == "n";
  if (!is_parameter || is_dear || curve.points.size() < 2) {
    std::vector<Gas> gases;
    for (const CurvePoint& point : curve.points) {
      gases.push_back(curve.gases[point.gas]);
      x.push_back(point.x);
    }
    return gases;
  }
  x = steps(curve.points.front().x, curve.points.back().x, 40);
  if (topic.x == "e")  // the table of direct simulations has further values of e
    for (const double e : analysis::tabulated_restitutions(curve.gases.front().job.d))
      if (e > x.front() && e < x.back()) x.push_back(e);
  std::ranges::sort(x);
  std::vector<Gas> gases;
  for (const double value : x) {
    Gas gas = curve.gases.front();
    (topic.x == "e" ? gas.job.e.emplace() : gas.job.n) = value;
    // A reference with another e keeps it; one with other effects takes the same e or n.
    if (gas.reference && gas.reference->effects != gas.job.effects)
      (topic.x == "e" ? gas.reference->e.emplace() : gas.reference->n) = value;
    gases.push_back(std::move(gas));
  }
  return gases;
}

std::vector<PlacedLine> theory_of_gases(const Topic& topic, const GasCurve& curve, bool is_dear) {
  std::vector<double> x;
  const auto gases = gases_between(topic, curve, is_dear, x);
  std::vector<PlacedLine> placed;
  for (std::size_t i = 0; i < gases.size(); ++i) {
    const auto lines = theory_of(gases[i], [&](const schema::Job& job) {
      if (topic.kind == Topic::Kind::quantity) return theory_of_quantity(topic.quantity, job);
      if (!topic.window) return std::vector<TheoryLine>{};
      return theory_of_mean(topic.y, job, topic.window->first, topic.window->second);
    });
    for (const TheoryLine& line : lines) {
      auto found = std::ranges::find(placed, line.name,
                                     [](const PlacedLine& each) { return each.line.name; });
      if (found == placed.end()) {
        placed.push_back({line, {}});
        placed.back().line.values.clear();
        found = std::prev(placed.end());
      }
      found->x.push_back(x[i]);
      found->line.values.push_back(line.values.front());
    }
  }
  return placed;
}

bool is_dear(const GasCurve& curve) {
  return std::ranges::any_of(curve.gases, [](const Gas& gas) {
    return gas.job.effects.contains("thermostat") || gas.job.effects.contains("restitution");
  });
}

// Theories with correlations take chi for their lengths; so do Z, collision rates, and the time of
// a tau.
bool takes_contact_value(const Curve& curve, const std::string& x) {
  if (curve.source != Source::theory) return false;
  constexpr std::array marks{"_energy_equation", "compressible", "_enskog", "collision_rate",
                             "correlation_trace"};
  return x == "time" || std::ranges::any_of(marks, [&](const char* mark) {
           return curve.name.find(mark) != std::string::npos;
         });
}

}  // namespace

void add_theory(const Topic& topic, const std::vector<GasCurve>& gases, Panel& panel,
                std::vector<std::string>& notes) {
  std::vector<std::string> kinds;  // that have an entry in the legend
  std::vector<Curve> lines;
  std::size_t simulations = 0;
  bool any_left_out = false;
  for (std::size_t i = 0; i < gases.size(); ++i) {
    const bool dear = is_dear(gases[i]);
    if (dear) simulations += is_along_runs(topic) ? 1 : gases[i].gases.size();
    if (dear && simulations > most_simulations) {
      any_left_out = true;
      continue;
    }
    for (PlacedLine& each : is_along_runs(topic) ? theory_along_run(topic, gases[i])
                                                 : theory_of_gases(topic, gases[i], dear)) {
      const auto same = std::ranges::find_if(
          lines, [&](const Curve& line) { return line.x == each.x && line.y == each.line.values; });
      if (same != lines.end()) {
        same->colour = "#444444";
        continue;
      }
      Curve line{.name = each.line.name + (gases.size() > 1 ? ", " + panel.curves[i].name : ""),
                 .source = Source::theory,
                 .e = panel.curves[i].e,
                 .n = panel.curves[i].n,
                 .particles = panel.curves[i].particles,
                 .parameters = panel.curves[i].parameters,
                 .x = std::move(each.x),
                 .y = std::move(each.line.values),
                 .error = std::move(each.line.errors),
                 .look = each.line.look,
                 .colour = panel.curves[i].colour,
                 .width = 1.5};
      lines.push_back(std::move(line));
      if (std::ranges::find(kinds, each.line.legend) != kinds.end()) continue;
      kinds.push_back(each.line.legend);
      panel.curves.push_back({.legend = each.line.legend,
                              .source = Source::theory,
                              .look = each.line.look,
                              .colour = "#444444",
                              .width = 1.5});
    }
  }
  // Entries of the legend stand behind the gases, lines are drawn over all.
  panel.curves.insert(panel.curves.end(), lines.begin(), lines.end());
  if (lines.empty()) notes.emplace_back("No theory here knows this.");
  if (any_left_out)
    notes.push_back(
        fmt::format("The direct simulation is left out beyond {} gases.", most_simulations));
}

std::string contact_value_note(const Panel& panel) {
  const bool any = std::ranges::any_of(
      panel.curves, [&](const Curve& curve) { return takes_contact_value(curve, panel.x.column); });
  return any ? " Theory: χ of Carnahan and Starling, of disks Henderson's." : "";
}

}  // namespace haff::campaign
