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

// ---- all --------------------------------------------------------------------------------------

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
    auto shifts = shifts_of(quantity, gas);
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

}  // namespace

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

}  // namespace haff::campaign
