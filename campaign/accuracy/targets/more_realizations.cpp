// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/accuracy/targets/more_realizations.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "campaign/accuracy/targets/targets.hpp"
#include "campaign/planning/forecast.hpp"

namespace haff::campaign {

namespace {

// A realization and, unless it is there, its equilibration.
std::vector<schema::Planned> realization(const schema::JobRow& like, std::uint64_t seed,
                                         const schema::Reader& store, Forecast& forecast) {
  schema::Job job = like.job;
  job.seed = seed;
  std::vector<schema::Planned> plan{
      {.job = schema::equilibration_of(job),
       .tau_max = tau_max_of_equilibration(schema::equilibration_of(job)),
       .checkpoint_every = like.checkpoint_every},
      {.job = job, .tau_max = like.tau_max, .checkpoint_every = like.checkpoint_every}};
  if (store.find(plan.front().job)) plan.erase(plan.begin());
  for (schema::Planned& each : plan) each.expected_cpu_seconds = forecast.cpu_seconds(each);
  return plan;
}

}  // namespace

int add_realizations(schema::Store& store, const std::vector<schema::Target>& targets,
                     std::optional<double> affordable) {
  // Targets of one series are served by the same realizations.
  std::map<std::string, std::size_t> missing;
  for (const TargetProgress& each : progress_of(store, targets))
    if (each.verdict == Verdict::short_of) {
      std::size_t& most = missing[each.target.series];
      most = std::max(most, each.next - each.estimate.count);
    }
  if (missing.empty()) return 0;

  std::map<std::string, std::vector<schema::JobRow>> runs;
  for (schema::JobRow& row : store.jobs())
    if (missing.contains(row.series) && row.job.kind == schema::Kind::cooling)
      runs[row.series].push_back(std::move(row));
  Forecast forecast(store.jobs());
  int added = 0;
  for (const auto& [series, count] : missing) {
    const auto& rows = runs.at(series);
    std::set<std::uint64_t> taken;
    for (const schema::JobRow& row : rows) taken.insert(row.job.seed);
    std::uint64_t seed = 1;
    for (std::size_t k = 0; k < count; ++k) {
      while (taken.contains(seed)) ++seed;
      taken.insert(seed);
      const auto plan = realization(rows.front(), seed, store, forecast);
      if (affordable) {
        for (const schema::Planned& each : plan) *affordable -= *each.expected_cpu_seconds;
        if (*affordable < 0) return added;
      }
      store.add(plan);
      ++added;
    }
  }
  return added;
}

}  // namespace haff::campaign
