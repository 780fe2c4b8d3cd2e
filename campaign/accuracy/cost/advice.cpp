// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/accuracy/cost/advice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace haff::campaign {

namespace {

// Where no error is asked for, advice is given for today's error, and for one smaller by this
// factor.
constexpr double ambition = 10;

// With fewer runs the scatter, and with it the advice, is uncertain by a third.
constexpr std::size_t fewest_runs = 5;

// The errors wanted of a quantity: those that name its window before those of its measure.
std::vector<double> errors_wanted(const std::vector<CostTarget>& targets,
                                  const Quantity& quantity) {
  std::vector<double> named, general;
  for (const CostTarget& target : targets)
    if (is_meant(target, quantity)) (target.quantity ? named : general).push_back(target.error);
  return named.empty() ? general : named;
}

// The least error that a size of the gas has today.
double least_error(const Assessment& assessment, const std::string& gas, const Quantity& quantity) {
  double least = std::numeric_limits<double>::infinity();
  for (const Statistics& each : assessment.statistics)
    if (each.quantity == quantity && gas_key(each.job) == gas && each.error > 0)
      least = std::min(least, each.error);
  return least;
}

Advice advise(const Assessment& assessment, Advice wanted, Forecast& forecast) {
  wanted.offer = cheapest(assessment, wanted.gas, wanted.quantity, wanted.target);
  if (wanted.offer) {
    wanted.memory_bytes = forecast.memory_bytes(wanted.offer->job);
    if (wanted.offer->seen < fewest_runs)
      wanted.notes.push_back(fmt::format("rests on the scatter of {} run{}", wanted.offer->seen,
                                         wanted.offer->seen == 1 ? "" : "s"));
  }
  const auto is_complete = [&](const Statistics& each) {
    return each.quantity == wanted.quantity && gas_key(each.job) == wanted.gas &&
           each.unfinished == 0;
  };
  if (std::ranges::none_of(assessment.statistics, is_complete))
    wanted.notes.emplace_back(R"(at no size do all runs reach it: plan a larger "tau_max")");
  if (smaller_might_do(assessment, wanted.gas, wanted.quantity, wanted.target))
    wanted.notes.emplace_back("more runs of the largest gas may allow a smaller one");
  return wanted;
}

}  // namespace

std::vector<Advice> advice(const Assessment& assessment, const std::vector<CostTarget>& targets,
                           Forecast& forecast) {
  std::vector<Advice> all;
  for (const Statistics& each : assessment.statistics) {
    const std::string gas = gas_key(each.job);
    const auto known = std::ranges::any_of(all, [&](const Advice& advised) {
      return advised.gas == gas && advised.quantity == each.quantity;
    });
    if (known || !(each.error > 0)) continue;
    auto errors = errors_wanted(targets, each.quantity);
    if (targets.empty()) {
      const double today = least_error(assessment, gas, each.quantity);
      errors = {today, today / ambition};
    }
    for (const double error : errors)
      all.push_back(advise(assessment, {each.quantity, gas, each.job, error}, forecast));
  }
  return all;
}

std::vector<Quantity> asked_by(const std::vector<CostTarget>& targets) {
  std::vector<Quantity> all;
  for (const CostTarget& target : targets) {
    if (target.quantity)
      all.push_back(*target.quantity);
    else if (is_laguerre(target.measure) || target.measure == Measure::tau_c)
      all.push_back(usual_quantity(target.measure));
  }
  return all;
}

}  // namespace haff::campaign
