#include "campaign/commands/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <vector>

#include "campaign/accuracy/targets.hpp"
#include "campaign/base/cpu_time.hpp"
#include "campaign/base/duration.hpp"
#include "campaign/base/exit_code.hpp"
#include "campaign/base/output.hpp"
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
    if (stop_signal() != 0) return ended;
    keep_predictions(store);
    if (ended.over_limit || ended.store_error) return ended;
    std::optional<double> affordable = options.cpu_budget;
    if (affordable) *affordable -= cpu_seconds_of_ended_children();
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

// Why a run with a limit ended, where that is not plain from the tables.
void print_limits(const RunOptions& options, const RoundEnd& ended, int exit_code) {
  if (ended.seconds_needed && exit_code == exit_out_of_time)
    say("Jobs are left that --max-time is too short for: it must leave at least {} to store "
        "anything of one\n",
        duration_text(*ended.seconds_needed));
  if (options.cpu_budget && exit_code == exit_out_of_time)
    say("Stopped: {} of CPU time spent, --budget allows {}\n",
        duration_text(cpu_seconds_of_ended_children()), duration_text(*options.cpu_budget));
}

}  // namespace

int run(const RunOptions& options) {
  note_stop_signals();
  schema::Store store = schema::Store::open(options.store);
  store.wait_for_locks_while(may_wait_for_locks);
  const RoundEnd ended = run_rounds(store, options);
  const int exit_code = conclusion(store.summary(), progress_of(store, store.targets()), ended);
  print_limits(options, ended, exit_code);
  print_outcome(store);
  return exit_code;
}

}  // namespace haff::campaign
