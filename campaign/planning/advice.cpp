// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/planning/advice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <unordered_set>

#include "campaign/base/text/number_text.hpp"

namespace haff::campaign {
namespace {

// Two values that differ by less were meant to be equal. [relative]
constexpr double twins = 1e-9;

// A parameter of each job that may be typed with rounding; nothing where the job has none.
struct Parameter {
  const char* name;
  std::optional<double> (*of)(const schema::Job&);
};

constexpr Parameter parameters[] = {
    {"e", [](const schema::Job& job) { return job.e; }},
    {"n", [](const schema::Job& job) { return std::optional(job.n); }},
    {"sample_every", [](const schema::Job& job) { return std::optional(job.sample_every); }},
};

}  // namespace

std::vector<std::string> near_twins(const std::vector<schema::Planned>& plan,
                                    const std::vector<schema::JobRow>& known) {
  std::vector<std::string> lines;
  for (const Parameter& parameter : parameters) {
    std::set<double> old;
    for (const schema::JobRow& row : known)
      if (const auto value = parameter.of(row.job)) old.insert(*value);
    std::set<double> asked;
    for (const schema::Planned& planned : plan)
      if (const auto value = parameter.of(planned.job)) asked.insert(*value);
    for (const double value : asked) {
      if (old.contains(value)) continue;
      const auto next = old.lower_bound(value * (1 - twins));
      if (next != old.end() && std::abs(*next - value) <= twins * value)
        lines.push_back(fmt::format(
            "{0} = {1} of this grid and {2} of the store differ by less than 1e-9: they "
            "are two series.\n  Write {2} if they should be one.",
            parameter.name, number_text(value), number_text(*next)));
    }
  }
  return lines;
}

std::size_t recomputed(const std::vector<schema::Planned>& plan,
                       const std::vector<schema::JobRow>& known) {
  std::unordered_set<std::string> gases, jobs;
  for (const schema::JobRow& row : known) {
    if (row.job.kind != schema::Kind::cooling || row.progress.collisions == 0) continue;
    gases.insert(identity(unsampled(row.job)));
    jobs.insert(identity(row.job));
  }
  if (gases.empty()) return 0;
  return static_cast<std::size_t>(std::ranges::count_if(plan, [&](const schema::Planned& planned) {
    return planned.job.kind == schema::Kind::cooling && !jobs.contains(identity(planned.job)) &&
           gases.contains(identity(unsampled(planned.job)));
  }));
}

}  // namespace haff::campaign
