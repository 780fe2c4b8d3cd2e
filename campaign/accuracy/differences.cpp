// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/accuracy/differences.hpp"

#include <cmath>
#include <map>

#include "analysis/statistics/statistics.hpp"

namespace haff::campaign {
namespace {

std::map<std::uint64_t, double> values_by_seed(const Quantity& quantity,
                                               const FinishedSeries& series) {
  std::map<std::uint64_t, double> values;
  for (const FinishedRun& run : series.runs)
    if (const auto value = value_of(quantity, series.job, run)) values[run.seed] = *value;
  return values;
}

void add_difference(const Quantity& quantity, const FinishedSeries& series,
                    const FinishedSeries& reference, std::vector<Difference>& all) {
  const auto difference =
      paired_difference(values_by_seed(quantity, series), values_by_seed(quantity, reference));
  if (!difference) return;
  all.push_back({.quantity = quantity,
                 .job = series.job,
                 .reference = reference.job,
                 .difference = *difference});
}

}  // namespace

std::string common_start(const schema::Job& job) {
  return schema::series_identity(schema::equilibration_of(job));
}

std::optional<PairedDifference> paired_difference(const std::map<std::uint64_t, double>& ours,
                                                  const std::map<std::uint64_t, double>& theirs) {
  std::vector<double> a, b, differences;
  for (const auto& [seed, value] : ours) {
    const auto found = theirs.find(seed);
    if (found == theirs.end()) continue;
    a.push_back(value);
    b.push_back(found->second);
    differences.push_back(value - found->second);
  }
  if (differences.size() < 2) return std::nullopt;
  const auto mean = analysis::estimate(differences);
  return PairedDifference{.pairs = differences.size(),
                          .value = mean.mean,
                          .error = mean.standard_error,
                          .independent = std::hypot(analysis::estimate(a).standard_error,
                                                    analysis::estimate(b).standard_error)};
}

std::vector<Difference> paired_differences(const std::vector<FinishedSeries>& all,
                                           const std::vector<Quantity>& quantities) {
  std::map<std::string, std::vector<const FinishedSeries*>> by_equilibration;
  for (const FinishedSeries& series : all)
    by_equilibration[common_start(series.job)].push_back(&series);
  std::vector<Difference> differences;
  for (const Quantity& quantity : quantities)
    for (const auto& [key, series] : by_equilibration)
      for (std::size_t i = 1; i < series.size(); ++i)
        add_difference(quantity, *series[i], *series[i - 1], differences);
  return differences;
}

}  // namespace haff::campaign
