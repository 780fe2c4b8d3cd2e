// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/accuracy/offer.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/statistics/accuracy.hpp"

namespace haff::campaign {
namespace {

// A shift that is not seen may still be as large as its error.
double finite_size_bound(const Assessment& assessment, const Statistics& statistics) {
  const BiasEstimate* shift = finite_size_shift(assessment, statistics);
  return shift == nullptr ? 0 : std::max(finite_size_error(assessment, statistics), shift->error);
}

// One size of the gas, for a target of which finite size uses up the part `bias`.
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
