// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/accuracy/targets/table.hpp"

#include <fmt/format.h>

#include "campaign/accuracy/quantity.hpp"
#include "campaign/base/text/duration.hpp"
#include "campaign/base/text/job_text.hpp"
#include "campaign/base/text/number_text.hpp"
#include "campaign/base/text/text_table.hpp"

namespace haff::campaign {

namespace {

std::string verdict_text(const TargetProgress& progress) {
  const std::string text = name(progress.verdict);
  return progress.reason.empty() ? text : text + ": " + progress.reason;
}

// The number of realizations is not known before the pilot runs are done.
std::string to_come_text(const TargetProgress& progress) {
  const double seconds = progress.cpu_seconds_to_come();
  if (seconds <= 0) return no_value;
  return progress.expected > 0 ? duration_text(seconds) : "> " + duration_text(seconds);
}

}  // namespace

std::string targets_table(const std::vector<TargetProgress>& targets) {
  if (targets.empty()) return "";
  TextTable table({{"target", Align::left},
                   {"e"},
                   {"n"},
                   {"N"},
                   {"wanted"},
                   {"mean"},
                   {"error"},
                   {"95 % interval"},
                   {"runs"},
                   {"expected"},
                   {"CPU time to come"},
                   {"", Align::left}});
  for (const TargetProgress& each : targets) {
    const analysis::Estimate& estimate = each.estimate;
    table.add({describe(quantity_of(each.target)), e_text(each.job), number_text(each.job.n),
               count_text(each.job.particles), fmt::format("{:.1e}", each.target.se),
               estimate.count > 0 ? value_text(estimate.mean, estimate.standard_error) : no_value,
               estimate.count > 1 ? fmt::format("{:.1e}", estimate.standard_error) : no_value,
               each.half_interval ? fmt::format("± {:.1e}", *each.half_interval) : no_value,
               count_text(static_cast<long long>(estimate.count)),
               each.expected > 0 ? count_text(static_cast<long long>(each.expected)) : no_value,
               to_come_text(each), verdict_text(each)});
  }
  return table.text();
}

}  // namespace haff::campaign
