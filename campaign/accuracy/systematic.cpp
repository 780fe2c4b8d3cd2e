// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/accuracy/systematic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "analysis/statistics/interpolation.hpp"
#include "analysis/statistics/statistics.hpp"
#include "campaign/base/text/job_text.hpp"
#include "campaign/base/text/number_text.hpp"
#include "campaign/base/text/text_table.hpp"

namespace haff::campaign {
namespace {

using analysis::Estimate;

// Every second and every fifth sample.
constexpr std::size_t thinned[] = {2, 5};

// A condition in which series of one gas may differ, and how good it is: more is better.
struct Condition {
  SystematicEffect cause;
  void (*neutralize)(schema::Job&);
  double (*goodness)(const schema::Job&);
  std::string (*text)(const schema::Job&);
};

const Condition conditions[] = {
    {SystematicEffect::finite_size, [](schema::Job& job) { job.particles = 0; },
     [](const schema::Job& job) { return static_cast<double>(job.particles); },
     [](const schema::Job& job) { return "N = " + count_text(job.particles); }},
    {SystematicEffect::equilibration, [](schema::Job& job) { job.equilibrate = 0; },
     [](const schema::Job& job) { return job.equilibrate; },
     [](const schema::Job& job) { return "equilibrate = " + number_text(job.equilibrate); }},
};

// Series that differ in the condition alone; of several with the same, the one of most
// realizations.
using Alternatives = std::map<double, const FinishedSeries*>;  // by goodness

std::vector<Alternatives> alternatives(const Condition& condition,
                                       const std::vector<const FinishedSeries*>& gas) {
  std::map<std::string, Alternatives> groups;
  for (const FinishedSeries* series : gas) {
    schema::Job job = unsampled(series->job);
    condition.neutralize(job);
    const FinishedSeries*& place =
        groups[schema::series_identity(job)][condition.goodness(series->job)];
    if (place == nullptr || place->runs.size() < series->runs.size()) place = series;
  }
  std::vector<Alternatives> all;
  all.reserve(groups.size());
  for (auto& [key, group] : groups) all.push_back(std::move(group));
  return all;
}

void add_condition_shifts(const Condition& condition, const Quantity& quantity,
                          const std::vector<const FinishedSeries*>& gas,
                          std::vector<BiasEstimate>& shifts) {
  for (const Alternatives& group : alternatives(condition, gas)) {
    const FinishedSeries& best = *group.rbegin()->second;
    const auto reference = values_of(quantity, best);
    if (reference.size() < 2 || unfinished(quantity, best) > 0) continue;
    const Estimate better = analysis::estimate(reference);
    for (const auto& [goodness, series] : group) {
      const auto values = values_of(quantity, *series);
      if (series == &best || values.size() < 2 || unfinished(quantity, *series) > 0) continue;
      const Estimate here = analysis::estimate(values);
      shifts.push_back({.quantity = quantity,
                        .job = series->job,
                        .cause = condition.cause,
                        .change = fmt::format("{}, not {}", condition.text(series->job),
                                              condition.text(best.job)),
                        .value = here.mean - better.mean,
                        .error = std::hypot(here.standard_error, better.standard_error)});
    }
  }
}

// Differences within each realization, so that fluctuations that both share cancel.
void add_paired_shift(const Quantity& quantity, const FinishedSeries& series,
                      SystematicEffect cause, const std::string& change,
                      const std::function<std::optional<double>(const FinishedRun&)>& changed,
                      std::vector<BiasEstimate>& shifts) {
  std::vector<double> differences;
  for (const FinishedRun& run : series.runs) {
    const auto as_it_is = value_of(quantity, series.job, run), other = changed(run);
    if (as_it_is && other) differences.push_back(*other - *as_it_is);
  }
  if (differences.size() < 2) return;
  const Estimate shift = analysis::estimate(differences);
  const bool same = shift.mean == 0 && shift.standard_error == 0;
  shifts.push_back({.quantity = quantity,
                    .job = series.job,
                    .cause = cause,
                    .change = change + (same ? ": the same samples" : ""),
                    .value = shift.mean,
                    .error = shift.standard_error});
}

void add_sampling_shifts(const Quantity& quantity, const FinishedSeries& series,
                         std::vector<BiasEstimate>& shifts) {
  const schema::Job& job = series.job;
  if (quantity.measure == Measure::correlation) return;
  for (const std::size_t every : thinned) {
    const double interval = static_cast<double>(every) * job.sample_every;
    const bool has_window = quantity.from < quantity.to;
    if (has_window && interval > (quantity.to - quantity.from) / 2) continue;
    add_paired_shift(
        quantity, series, SystematicEffect::sampling,
        fmt::format("a sample every {:g}, not {:g}", interval, job.sample_every),
        [&](const FinishedRun& run) { return value_of(quantity, job, run, every); }, shifts);
  }
  if (quantity.from >= quantity.to) return;
  const Quantity half = middle_half(quantity);
  add_paired_shift(
      quantity, series, SystematicEffect::averaging,
      fmt::format("mean over tau {:g} to {:g}", half.from, half.to),
      [&](const FinishedRun& run) { return value_of(half, job, run); }, shifts);
}

// The same states on wider cells: those that are stored, at the end of the runs.
void add_mesh_shift(Quantity quantity, const FinishedSeries& series,
                    std::vector<BiasEstimate>& shifts) {
  quantity.from = quantity.to = series.runs.front().mesh->usual.tau;
  std::vector<double> values, differences;
  for (const FinishedRun& run : series.runs) {
    if (!run.mesh || run.mesh->usual.tau != quantity.to) continue;
    const auto at_r = [&](const schema::Profile& profile) {
      return analysis::interpolated(profile.x, profile.value, quantity.r);
    };
    const auto usual = at_r(run.mesh->usual), wide = at_r(run.mesh->wide);
    if (!usual || !wide) continue;
    values.push_back(*usual);
    differences.push_back(*wide - *usual);
  }
  if (differences.size() < 2) return;
  const Estimate shift = analysis::estimate(differences);
  shifts.push_back({.quantity = quantity,
                    .job = series.job,
                    .cause = SystematicEffect::mesh,
                    .change = fmt::format("cells of {:g} sigma, not 1, at tau {:g}: of {:.1e}",
                                          wide_cell, quantity.to, analysis::estimate(values).mean),
                    .value = shift.mean,
                    .error = shift.standard_error});
}

// The series with the most particles in all realizations together, which has the least noise; among
// equals the largest gas, which is nearest to an infinite one. Nothing if none has two values, or
// if not every run has its tau_c.
const FinishedSeries* quietest(const Quantity& quantity,
                               const std::vector<const FinishedSeries*>& gas) {
  const FinishedSeries* best = nullptr;
  std::pair<double, std::uint32_t> most;
  for (const FinishedSeries* series : gas) {
    const std::size_t realizations = values_of(quantity, *series).size();
    if (realizations < 2 || unfinished(quantity, *series) > 0) continue;
    const std::pair here(
        static_cast<double>(series->job.particles) * static_cast<double>(realizations),
        series->job.particles);
    if (best != nullptr && here <= most) continue;
    best = series;
    most = here;
  }
  return best;
}

// The series whose stored states are nearest to the quantity's tau.
std::vector<const FinishedSeries*> nearest_meshed(const Quantity& quantity,
                                                  std::vector<const FinishedSeries*> gas) {
  std::erase_if(gas, [](const FinishedSeries* series) { return !series->runs.front().mesh; });
  const auto distance = [&](const FinishedSeries* series) {
    return std::abs(series->runs.front().mesh->usual.tau - quantity.to);
  };
  if (gas.empty()) return gas;
  const double least = distance(*std::ranges::min_element(gas, {}, distance));
  std::erase_if(gas, [&](const FinishedSeries* series) { return distance(series) > least; });
  return gas;
}

}  // namespace

std::vector<BiasEstimate> shifts_of(const Quantity& quantity,
                                    const std::vector<const FinishedSeries*>& gas) {
  std::vector<BiasEstimate> shifts;
  for (const Condition& condition : conditions)
    add_condition_shifts(condition, quantity, gas, shifts);
  if (const FinishedSeries* series = quietest(quantity, gas))
    add_sampling_shifts(quantity, *series, shifts);
  if (quantity.measure == Measure::correlation)
    if (const FinishedSeries* series = quietest(quantity, nearest_meshed(quantity, gas)))
      add_mesh_shift(quantity, *series, shifts);
  return shifts;
}

bool is_moved(const Quantity& quantity, SystematicEffect cause) {
  const bool is_of_mesh = quantity.measure == Measure::correlation;
  switch (cause) {
    case SystematicEffect::mesh:
      return is_of_mesh;
    case SystematicEffect::sampling:
      return !is_of_mesh;
    case SystematicEffect::averaging:
      return quantity.from < quantity.to;
    default:
      return true;
  }
}

std::string name(SystematicEffect cause) {
  switch (cause) {
    case SystematicEffect::finite_size:
      return "finite size";
    case SystematicEffect::equilibration:
      return "equilibration";
    case SystematicEffect::sampling:
      return "sampling";
    case SystematicEffect::averaging:
      return "averaging";
    case SystematicEffect::mesh:
      return "mesh";
  }
  throw std::logic_error("unknown cause");
}

std::string gas_key(schema::Job job) {
  job = unsampled(std::move(job));
  for (const Condition& condition : conditions) condition.neutralize(job);
  return schema::series_identity(job);
}

}  // namespace haff::campaign
