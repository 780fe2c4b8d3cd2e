// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/accuracy/assessment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "analysis/statistics/interpolation.hpp"
#include "analysis/statistics/statistics.hpp"
#include "analysis/theory/energy_equation.hpp"
#include "campaign/base/text/job_text.hpp"
#include "campaign/base/text/number_text.hpp"
#include "campaign/base/text/text_table.hpp"

namespace haff::campaign {
namespace {

using analysis::Estimate;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

// gamma: at the plateau of a_2, and where velocity correlations are seen. [tau]
constexpr double decay_at[] = {10, 50};

// G_parallel: the paper's. [tau]
constexpr double correlation_tau = 50;

// Every second and every fifth sample.
constexpr std::size_t thinned[] = {2, 5};

// ---- which quantities -------------------------------------------------------------------------

std::optional<double> latest_correlation(const std::vector<const FinishedSeries*>& gas) {
  std::optional<double> latest;
  for (const FinishedSeries* series : gas)
    for (const schema::Profile& profile : series->runs.front().correlations)
      if (profile.tau <= correlation_tau && profile.tau > latest.value_or(0)) latest = profile.tau;
  return latest;
}

bool decays(const schema::Job& job) {
  return cools_by_haff(job) && *job.e < 1;
}

bool has_target(const std::vector<const FinishedSeries*>& gas, const schema::Target& target) {
  return std::ranges::any_of(gas, [&](const FinishedSeries* series) {
    return schema::series_identity(series->job) == target.series;
  });
}

bool has_tau_c(const std::vector<const FinishedSeries*>& gas) {
  return std::ranges::any_of(gas, [](const FinishedSeries* series) {
    return std::ranges::any_of(series->runs,
                               [](const FinishedRun& run) { return run.tau_c.has_value(); });
  });
}

struct Wanted {
  const std::vector<schema::Target>& targets;
  const std::vector<Quantity>& asked;
};

std::vector<Quantity> quantities_of(const std::vector<const FinishedSeries*>& gas,
                                    const Wanted& wanted) {
  std::vector<Quantity> all{usual_quantity(Measure::a2), usual_quantity(Measure::a3)};
  const schema::Job& job = gas.front()->job;
  if (decays(job))
    for (const double tau : decay_at) all.push_back(usual_quantity(Measure::gamma_ratio, tau));
  if (job.d == 3 && decays(job))  // one tau for all sizes, whatever their own tau_c
    all.push_back(
        usual_quantity(Measure::ln_temperature,
                       std::round(analysis::energy_equation_tau_c({.e = *job.e, .n = job.n}))));
  if (decays(job) || has_tau_c(gas)) all.push_back(usual_quantity(Measure::tau_c));
  all.push_back(
      usual_quantity(Measure::correlation, latest_correlation(gas).value_or(correlation_tau)));

  const auto add = [&](const Quantity& quantity) {
    if (std::ranges::find(all, quantity) == all.end()) all.push_back(quantity);
  };
  for (const schema::Target& target : wanted.targets)
    if (has_target(gas, target)) add(quantity_of(target));
  for (const Quantity& quantity : wanted.asked) add(quantity);
  return all;
}

// ---- chance -----------------------------------------------------------------------------------

std::vector<double> values_of(const Quantity& quantity, const FinishedSeries& series) {
  std::vector<double> values;
  for (const FinishedRun& run : series.runs)
    if (const auto value = value_of(quantity, series.job, run)) values.push_back(*value);
  return values;
}

// Runs that ended before their tau_c. Those that did not are the early ones, and their mean is no
// tau_c of the gas.
std::size_t unfinished(const Quantity& quantity, const FinishedSeries& series) {
  if (quantity.measure != Measure::tau_c) return 0;
  return series.runs.size() - values_of(quantity, series).size();
}

double mean_cpu_seconds(const Quantity& quantity, const FinishedSeries& series) {
  double sum = 0;
  for (const FinishedRun& run : series.runs) sum += cpu_seconds(quantity, run);
  return sum / static_cast<double>(series.runs.size());
}

// The target that the series was run for, if it was run for one of this quantity.
const schema::Target* target_of(const Quantity& quantity, const FinishedSeries& series,
                                const std::vector<schema::Target>& targets) {
  const auto found = std::ranges::find_if(targets, [&](const schema::Target& target) {
    return quantity_of(target) == quantity && target.series == schema::series_identity(series.job);
  });
  return found == targets.end() ? nullptr : &*found;
}

std::optional<Statistics> statistics_of(const Quantity& quantity, const FinishedSeries& series,
                                        const std::vector<schema::Target>& targets) {
  const auto values = values_of(quantity, series);
  if (values.empty()) return std::nullopt;
  const Estimate estimate = analysis::estimate(values);
  Statistics result{.quantity = quantity,
                    .job = series.job,
                    .realizations = values.size(),
                    .mean = estimate.mean,
                    .error = estimate.standard_error,
                    .half_interval = none,
                    .interval_runs = values.size(),
                    .deviation = none,
                    .cpu_seconds = mean_cpu_seconds(quantity, series),
                    .unfinished = unfinished(quantity, series)};
  if (values.size() == 1) {
    if (const auto blocks = error_within(quantity, series.job, series.runs.front())) {
      result.error = blocks->standard_error;
      result.deviation = blocks->standard_error;
      result.correlation_time = blocks->correlation_time;
    }
    return result;
  }
  result.half_interval = analysis::half_interval(estimate, values.size());
  if (const schema::Target* target = target_of(quantity, series, targets))
    if (const auto half = half_interval(*target, series)) {
      result.half_interval = *half;
      result.interval_runs = target->pilots.size();
    }
  result.deviation = analysis::standard_deviation(estimate);
  result.scatter = analysis::group_scatter(values);
  if (result.scatter.size() > 1 && result.deviation > 0)
    result.slope = analysis::scatter_slope(result.scatter);
  return result;
}

// ---- what moves the mean ----------------------------------------------------------------------

// How a job was prepared, without how it was looked at.
schema::Job unobserved(schema::Job job) {
  job.sample_every = 1;
  job.observables.clear();
  job.profiles_every = std::nullopt;
  job.fields_at.clear();
  return job;
}

// A condition that series of one gas may differ in, and how good it is: the more the better.
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
    schema::Job job = unobserved(series->job);
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

// Differences within each realization, so that what chance does to both is not in their error.
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

// ---- all --------------------------------------------------------------------------------------

// Of those with the most particles in all realizations together the noise is least; of equals the
// largest gas is nearest to an infinite one. Nothing if none has two values, or each run its tau_c.
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

// Those whose stored states are nearest to the quantity's tau.
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

void add_shifts(const Quantity& quantity, const std::vector<const FinishedSeries*>& gas,
                std::vector<BiasEstimate>& shifts) {
  for (const Condition& condition : conditions)
    add_condition_shifts(condition, quantity, gas, shifts);
  if (const FinishedSeries* series = quietest(quantity, gas))
    add_sampling_shifts(quantity, *series, shifts);
  if (quantity.measure == Measure::correlation)
    if (const FinishedSeries* series = quietest(quantity, nearest_meshed(quantity, gas)))
      add_mesh_shift(quantity, *series, shifts);
}

// What may move the quantity at all: a correlation is of one state, others of samples.
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

void assess_gas(const std::vector<const FinishedSeries*>& gas, const Wanted& wanted,
                Assessment& assessment) {
  const schema::Job& job = gas.front()->job;
  for (const Quantity& quantity : quantities_of(gas, wanted)) {
    const std::size_t before = assessment.statistics.size();
    for (const FinishedSeries* series : gas)
      if (auto statistics = statistics_of(quantity, *series, wanted.targets))
        assessment.statistics.push_back(*std::move(statistics));
    if (assessment.statistics.size() == before) {
      const bool reached = std::ranges::any_of(gas, [&](const FinishedSeries* series) {
        return quantity.measure != Measure::tau_c && series->runs.front().tau_max >= quantity.to;
      });
      assessment.absent.push_back({.quantity = quantity, .job = job, .reached = reached});
      continue;
    }
    std::vector<BiasEstimate> shifts;
    add_shifts(quantity, gas, shifts);
    for (const SystematicEffect cause :
         {SystematicEffect::finite_size, SystematicEffect::equilibration,
          SystematicEffect::sampling, SystematicEffect::averaging, SystematicEffect::mesh})
      if (is_moved(quantity, cause) && std::ranges::none_of(shifts, [&](const BiasEstimate& shift) {
            return shift.cause == cause;
          }))
        assessment.unknown.push_back({.cause = cause, .quantity = quantity, .job = job});
    std::ranges::move(shifts, std::back_inserter(assessment.shifts));
  }
}

// A shift that is not seen may still be as large as its error.
double finite_size_bound(const Assessment& assessment, const Statistics& statistics) {
  const BiasEstimate* shift = finite_size_shift(assessment, statistics);
  return shift == nullptr ? 0 : std::max(finite_size_error(assessment, statistics), shift->error);
}

// One size of the gas, for a target, of which finite size has taken `bias`.
std::optional<Offer> offer(const Statistics& each, double target, double bias) {
  if (bias >= target || !(each.deviation > 0)) return std::nullopt;
  const auto realizations =
      analysis::realizations_needed(each.deviation, std::sqrt(target * target - bias * bias));
  return Offer{.job = each.job,
               .realizations = realizations,
               .cpu_seconds = static_cast<double>(realizations) * each.cpu_seconds,
               .finite_size = bias,
               .seen = each.realizations};
}

bool is_candidate(const Statistics& each, const std::string& gas, const Quantity& quantity) {
  return each.quantity == quantity && gas_key(each.job) == gas && each.unfinished == 0;
}

}  // namespace

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
  job = unobserved(std::move(job));
  for (const Condition& condition : conditions) condition.neutralize(job);
  return schema::series_identity(job);
}

Assessment assess(const std::vector<FinishedSeries>& all,
                  const std::vector<schema::Target>& targets, const std::vector<Quantity>& asked) {
  std::vector<std::string> order;
  std::map<std::string, std::vector<const FinishedSeries*>> gases;
  for (const FinishedSeries& series : all) {
    auto& gas = gases[gas_key(series.job)];
    if (gas.empty()) order.push_back(gas_key(series.job));
    gas.push_back(&series);
  }
  Assessment assessment;
  for (const std::string& key : order) assess_gas(gases[key], {targets, asked}, assessment);
  return assessment;
}

const BiasEstimate* finite_size_shift(const Assessment& assessment, const Statistics& statistics) {
  const auto found = std::ranges::find_if(assessment.shifts, [&](const BiasEstimate& shift) {
    return shift.cause == SystematicEffect::finite_size && shift.quantity == statistics.quantity &&
           shift.job.particles == statistics.job.particles &&
           gas_key(shift.job) == gas_key(statistics.job);
  });
  return found == assessment.shifts.end() ? nullptr : &*found;
}

double finite_size_error(const Assessment& assessment, const Statistics& statistics) {
  const BiasEstimate* shift = finite_size_shift(assessment, statistics);
  if (shift == nullptr) return 0;
  return std::sqrt(std::max(0.0, shift->value * shift->value - shift->error * shift->error));
}

std::optional<Offer> cheapest(const Assessment& assessment, const std::string& gas,
                              const Quantity& quantity, double target) {
  std::optional<Offer> best;
  for (const Statistics& each : assessment.statistics) {
    if (!is_candidate(each, gas, quantity)) continue;
    const auto here = offer(each, target, finite_size_bound(assessment, each));
    if (here && (!best || here->cpu_seconds < best->cpu_seconds)) best = here;
  }
  return best;
}

bool smaller_might_do(const Assessment& assessment, const std::string& gas,
                      const Quantity& quantity, double target) {
  const auto best = cheapest(assessment, gas, quantity, target);
  return std::ranges::any_of(assessment.statistics, [&](const Statistics& each) {
    if (!is_candidate(each, gas, quantity) || finite_size_bound(assessment, each) < target)
      return false;
    const auto here = offer(each, target, finite_size_error(assessment, each));
    return here && (!best || (here->job.particles < best->job.particles &&
                              here->cpu_seconds < best->cpu_seconds));
  });
}

}  // namespace haff::campaign
