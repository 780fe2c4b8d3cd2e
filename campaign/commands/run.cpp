#include "campaign/commands/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <vector>

#include "campaign/accuracy/targets.hpp"
#include "campaign/base/cpu_time.hpp"
#include "campaign/base/duration.hpp"
#include "campaign/base/exit_code.hpp"
#include "campaign/base/signals.hpp"
#include "campaign/commands/status.hpp"
#include "campaign/run/work_left.hpp"

namespace haff::campaign {
namespace {

// Round by round, until the targets are met or something ends it.
RoundEnd run_rounds(schema::Store& store, const RunOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  for (;;) {
    const RoundEnd ended = run_round(store, options, start);
    keep_predictions(store);
    if (ended.over_limit || ended.store_error || stop_signal() != 0) return ended;
    std::optional<double> affordable = options.cpu_budget;
    if (affordable) *affordable -= cpu_seconds_of_the_buried();
    if (add_realizations(store, affordable) == 0) return ended;
  }
}

bool any(const std::vector<TargetProgress>& targets, Verdict verdict) {
  return std::ranges::any_of(targets,
                             [=](const TargetProgress& each) { return each.verdict == verdict; });
}

int conclusion(const schema::Summary& summary, const std::vector<TargetProgress>& targets,
               const RoundEnd& ended) {
  if (stop_signal() != 0) return exit_signal_base + stop_signal();
  if (ended.store_error) return exit_failed;
  if (ended.over_limit && may_have_work(summary)) return exit_out_of_time;
  if (summary.jobs.at(schema::Status::failed) > 0 || summary.blocked > 0) return exit_failed;
  if (any(targets, Verdict::short_of)) return exit_out_of_time;
  return any(targets, Verdict::unreachable) ? exit_failed : exit_complete;
}

// Why a run with a budget ended, where that is not plain from the tables.
void print_budget(const RunOptions& options, int exit_code) {
  if (options.cpu_budget && exit_code == exit_out_of_time)
    fmt::print("Stopped: {} of CPU time spent, --budget allows {}\n",
               duration_text(cpu_seconds_of_the_buried()), duration_text(*options.cpu_budget));
}

}  // namespace

int run(const RunOptions& options) {
  note_stop_signals();
  schema::Store store = schema::Store::open(options.store);
  const RoundEnd ended = run_rounds(store, options);
  const int exit_code = conclusion(store.summary(), progress_of(store, store.targets()), ended);
  print_budget(options, exit_code);
  print_outcome(store);
  return exit_code;
}

}  // namespace haff::campaign
