// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/curves/gas_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "analysis/statistics/statistics.hpp"
#include "campaign/accuracy/differences.hpp"
#include "campaign/base/text/number_text.hpp"
#include "campaign/curves/observations.hpp"
#include "campaign/results/averages.hpp"
#include "schema/database/sql_names.hpp"

namespace haff::campaign {
namespace {

using BySeed = std::map<std::uint64_t, Reading>;

Observations observed(const schema::Reader& store, const Vocabulary& words, const Topic& topic) {
  switch (topic.kind) {
    case Topic::Kind::series:
      return samples_of(store, words, topic.y, topic.x, topic.where);
    case Topic::Kind::profile:
      return profiles_of(store, words, topic.y, topic.where);
    case Topic::Kind::mean:
      return means_of(store, words, topic.y, topic.x, topic.where);
    case Topic::Kind::quantity:
      return quantities_of(store, words, topic.quantity, topic.x, topic.where);
  }
  return {};
}

// The order of a_2 ... a_6, whose errors are known beforehand; 0 for all other columns.
int laguerre_order(const Topic& topic) {
  const std::string& y = topic.y;
  const bool is_one = y.size() == 2 && y[0] == 'a' && y[1] >= '2' && y[1] <= '6';
  return is_one && topic.kind == Topic::Kind::series ? y[1] - '0' : 0;
}

// The mean; where all values are equal it is that value, without rounding.
double mean_x(const BySeed& readings) {
  const double first = readings.begin()->second.x;
  if (std::ranges::all_of(readings, [&](const auto& each) { return each.second.x == first; }))
    return first;
  std::vector<double> x;
  for (const auto& [seed, reading] : readings) x.push_back(reading.x);
  return analysis::estimate(x).mean;
}

GasCurve mean_of(const Observation& observation, int laguerre) {
  const schema::Job& job = observation.scene.job;
  GasCurve curve{.scene = observation.scene, .gases = {{.job = job}}};
  for (const auto& [place, readings] : observation.readings) {
    std::vector<double> y;
    for (const auto& [seed, reading] : readings) y.push_back(reading.y);
    const auto mean = analysis::estimate(y);
    const auto realizations = static_cast<std::int64_t>(y.size());
    curve.points.push_back(
        {.x = mean_x(readings),
         .y = mean.mean,
         .error = error_of_mean(laguerre, mean.standard_error, realizations,
                                static_cast<double>(job.particles * realizations), job.d),
         .realizations = realizations});
  }
  return curve;
}

std::vector<GasCurve> means(const Observations& observations, int laguerre) {
  std::vector<GasCurve> curves;
  for (const Observation& each : observations.all) curves.push_back(mean_of(each, laguerre));
  return curves;
}

// ---- differences ------------------------------------------------------------------------------

// The gases that others are compared with: their parameter has this value, or they lack this
// effect.
struct Reference {
  std::string parameter, value, words;
  std::string effect = {};  // that they lack; empty: none

  explicit Reference(const std::pair<std::string, std::string>& wanted)
      : parameter(wanted.first), value(wanted.second), words(parameter + " = " + value) {
    if (value != "none") return;
    effect = effect_of(parameter).empty() ? parameter : effect_of(parameter);
    words = "no " + effect;
  }

  bool is(const Scene& scene) const {
    if (!effect.empty())
      return std::ranges::none_of(
          scene.parameters, [&](const auto& each) { return effect_of(each.first) == effect; });
    const ParameterValue* its = scene.find(parameter);
    const auto number = number_in(value);
    return its != nullptr && *its == (number ? ParameterValue(*number) : ParameterValue(value));
  }

  bool is_of(const Scene& candidate, const Scene& ours) const {
    return is(candidate) && agree(candidate, ours, effect.empty() ? parameter : effect);
  }
};

std::map<std::uint64_t, double> values(const BySeed& readings) {
  std::map<std::uint64_t, double> result;
  for (const auto& [seed, reading] : readings) result[seed] = reading.y;
  return result;
}

// There are no points where no two seeds start from the same states.
GasCurve difference_of(const Observation& ours, const Observation& theirs) {
  GasCurve curve{.scene = ours.scene,
                 .gases = {{.job = ours.scene.job, .reference = theirs.scene.job}}};
  if (common_start(ours.scene.job) != common_start(theirs.scene.job)) return curve;
  for (const auto& [place, readings] : ours.readings) {
    const auto there = theirs.readings.find(place);
    if (there == theirs.readings.end()) continue;
    const auto difference = paired_difference(values(readings), values(there->second));
    if (!difference) continue;
    const auto pairs = static_cast<std::int64_t>(difference->pairs);
    curve.points.push_back({.x = mean_x(readings),
                            .y = difference->value,
                            .error = bar(difference->error, pairs),
                            .realizations = pairs});
  }
  return curve;
}

std::string left_out(std::size_t count, const std::string& why) {
  return fmt::format("{} {} left out: {}.", count, count == 1 ? "gas is" : "gases are", why);
}

std::vector<GasCurve> differences(const Observations& observations, const Reference& reference,
                                  std::vector<std::string>& notes) {
  std::vector<GasCurve> curves;
  std::size_t references = 0, alone = 0, strangers = 0;
  for (const Observation& each : observations.all) {
    if (reference.is(each.scene)) {
      ++references;
      continue;
    }
    const auto partner = std::ranges::find_if(observations.all, [&](const Observation& other) {
      return reference.is_of(other.scene, each.scene);
    });
    if (partner == observations.all.end()) {
      ++alone;
      continue;
    }
    GasCurve curve = difference_of(each, *partner);
    if (curve.points.empty())
      ++strangers;
    else
      curves.push_back(std::move(curve));
  }
  if (references == 0)
    throw NothingToDraw(
        fmt::format("no finished run with {} to compare with; `campaign plot --list` names the "
                    "values there are",
                    reference.words));
  const std::string unlike =
      fmt::format("no gas with {} is like it in all other parameters", reference.words);
  const std::string apart = fmt::format(
      "no two of its seeds start from the same states as those with {}; a difference needs equal "
      "seeds, d, n, N and equilibrate",
      reference.words);
  if (curves.empty()) throw NothingToDraw(strangers > 0 ? apart : unlike);
  if (alone > 0) notes.push_back(left_out(alone, unlike));
  if (strangers > 0) notes.push_back(left_out(strangers, apart));
  return curves;
}

// ---- many gases on one curve ------------------------------------------------------------------

// Takes the parameters out of the scene that the variable is made of; the rest names the curve.
std::string take_out(const std::set<std::string>& variable, Scene& scene) {
  std::erase_if(scene.parameters, [&](const auto& each) { return variable.contains(each.first); });
  std::string rest;
  for (const auto& [name, value] : scene.parameters)
    rest += fmt::format("{}={};", name, value_text(value));
  return rest;
}

std::vector<GasCurve> joined(const Topic& topic, std::vector<GasCurve> singles) {
  std::set<std::string> variable;
  for (const std::string& name : schema::names_in(topic.x))
    variable.insert(name == "particles" ? "N" : name);
  std::map<std::string, std::size_t> place;
  std::vector<GasCurve> curves;
  for (GasCurve& single : singles) {
    const auto [found, is_new] = place.emplace(take_out(variable, single.scene), curves.size());
    if (is_new) {
      curves.push_back(std::move(single));
      continue;
    }
    GasCurve& curve = curves[found->second];
    single.points.front().gas = curve.gases.size();
    curve.gases.push_back(std::move(single.gases.front()));
    curve.points.push_back(single.points.front());
  }
  for (GasCurve& curve : curves) std::ranges::stable_sort(curve.points, {}, &CurvePoint::x);
  return curves;
}

std::string nothing(const Topic& topic) {
  std::string text = fmt::format("nothing to draw: no finished run has {}", topic.y);
  if (topic.kind == Topic::Kind::quantity)
    text = "nothing to draw: no finished run reached " + describe(topic.quantity);
  if (!is_along_runs(topic)) text += " and " + topic.x;
  if (!topic.where.empty()) text += fmt::format(", where {}", topic.where);
  return text + "; `campaign plot --list` names what the store has";
}

}  // namespace

std::int64_t GasCurve::most_realizations() const {
  return std::ranges::max_element(points, {}, &CurvePoint::realizations)->realizations;
}

std::int64_t GasCurve::fewest_realizations() const {
  return std::ranges::min_element(points, {}, &CurvePoint::realizations)->realizations;
}

bool is_along_runs(const Topic& topic) {
  return topic.kind == Topic::Kind::series || topic.kind == Topic::Kind::profile;
}

GasCurves gas_curves(const schema::Reader& store, const Vocabulary& words, const Topic& topic,
                     const Question& question) {
  Observations observations = observed(store, words, topic);
  if (observations.all.empty()) throw NothingToDraw(nothing(topic));
  GasCurves curves{.code_versions = observations.code_versions};
  if (question.difference)
    curves.all = differences(observations, Reference(*question.difference), curves.notes);
  if (!question.difference && std::ranges::find(question.by, "seed") != question.by.end())
    part_by_seed(observations);
  if (!question.difference) curves.all = means(observations, laguerre_order(topic));
  if (!is_along_runs(topic)) curves.all = joined(topic, std::move(curves.all));
  return curves;
}

}  // namespace haff::campaign
