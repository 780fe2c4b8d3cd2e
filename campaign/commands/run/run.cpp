// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/commands/run/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "campaign/accuracy/targets/more_realizations.hpp"
#include "campaign/accuracy/targets/targets.hpp"
#include "campaign/base/output/output.hpp"
#include "campaign/base/process/cpu_time.hpp"
#include "campaign/base/process/exit_code.hpp"
#include "campaign/base/process/signals.hpp"
#include "campaign/base/process/version.hpp"
#include "campaign/base/text/command_text.hpp"
#include "campaign/base/text/duration.hpp"
#include "campaign/base/text/error_text.hpp"
#include "campaign/commands/choosing.hpp"
#include "campaign/commands/run/status.hpp"
#include "campaign/run/event_log.hpp"
#include "campaign/run/on_finish.hpp"
#include "campaign/run/process.hpp"
#include "campaign/run/work_left.hpp"

namespace haff::campaign {
namespace {

// Those of gases of which some job is chosen.
std::vector<schema::Target> chosen_targets(const schema::Selection& store) {
  std::vector<schema::Target> targets = store.targets();
  if (store.choice().is_everything()) return targets;
  const auto series = store.series();
  std::erase_if(targets, [&](const schema::Target& each) { return !series.contains(each.series); });
  return targets;
}

// Round by round, until the targets are met or something ends it.
RoundEnd run_rounds(schema::Selection& store, const RunOptions& options, EventLog& log) {
  const auto start = std::chrono::steady_clock::now();
  for (;;) {
    const RoundEnd ended = run_round(store, options, start, log);
    if (stop_signal() != 0) return ended;
    keep_predictions(store);
    if (ended.over_limit || ended.store_error) return ended;
    std::optional<double> affordable = options.cpu_budget;
    if (affordable) *affordable -= cpu_seconds_of_ended_children();
    if (store.choice().names_realizations()) return ended;
    if (add_realizations(store, chosen_targets(store), affordable) == 0) return ended;
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

// Why a run with a limit ended, where the tables do not show it.
void print_limits(const RunOptions& options, const RoundEnd& ended, int exit_code) {
  if (ended.seconds_needed && exit_code == exit_out_of_time)
    say("Jobs are left that --max-time is too short for: it must leave at least {} to store "
        "anything of one\n",
        duration_text(*ended.seconds_needed));
  if (options.cpu_budget && exit_code == exit_out_of_time)
    say("Stopped: {} of CPU time spent, --budget allows {}\n",
        duration_text(cpu_seconds_of_ended_children()), duration_text(*options.cpu_budget));
}

// A process that still uses the store keeps its log.
void close_log(schema::Store& store) {
  constexpr std::chrono::milliseconds patience{1000};
  if (store.close_log(patience)) return;
  say("Another program still uses {0}: its log, {0}-wal, belongs to it and stays until a later run "
      "has ended\n",
      store.path().string());
}

// The file at the store's path is no longer the one that this run has written. This process can
// still read the old file as long as it has it open.
int rescue(schema::Store& store, const std::string& what) {
  const std::string name = store.path().string();
  std::filesystem::path saved;
  for (int k = 1; saved.empty() || std::filesystem::exists(saved); ++k)
    saved = fmt::format("{}.rescued-{}", name, k);
  complain("campaign: {} {} while the run was on\n", name, what);
  try {
    store.back_up(saved);
    store.abandon_log();
    complain(
        "All of it that could still be read is in {0}: look at it ({1}), then put it in its "
        "place\n",
        saved.string(), command_text("status", saved));
  } catch (const schema::StoreError& error) {
    const std::filesystem::path log = saved.string() + "-log";
    if (std::filesystem::exists(name)) store.abandon_log(log);
    complain(
        "Its contents could not be saved ({}): what this run computed is lost, and so is all that "
        "you have no copy of. If {} is to be used as it is now, {} finds out whether it can be\n",
        error_text(error), name, command_text("verify", store.path()));
  }
  return exit_failed;
}

// Pending jobs that this run has left alone, since they are not chosen.
std::int64_t not_chosen(const schema::Selection& store) {
  return store.job_counts()[schema::Status::pending] -
         store.summary().jobs.at(schema::Status::pending);
}

void print_not_chosen(const schema::Selection& store) {
  const std::int64_t count = not_chosen(store);
  if (count > 0)
    say("{} pending job{} not chosen by --where, and stay{} pending\n", count,
        count == 1 ? " was" : "s were", count == 1 ? "s" : "");
}

int work_to_the_end(schema::Selection& store, const RunOptions& options, EventLog& log) {
  store.open_log();
  const RoundEnd ended = run_rounds(store, options, log);
  if (store.displaced()) return exit_failed;
  const int exit_code =
      conclusion(store.summary(), progress_of(store, chosen_targets(store)), ended);
  if (options.json) {
    print_outcome_json(store, exit_code, not_chosen(store));
  } else {
    print_limits(options, ended, exit_code);
    print_outcome(store);
    print_not_chosen(store);
  }
  close_log(store);
  return exit_code;
}

int work_or_rescue(schema::Selection& store, const RunOptions& options, EventLog& log) {
  int exit_code = exit_failed;
  try {
    exit_code = work_to_the_end(store, options, log);
  } catch (const schema::StoreError&) {
    if (!store.displaced()) throw;
  }
  const auto what = store.displaced();
  return what ? rescue(store, *what) : exit_code;
}

void log_start(const RunOptions& options, EventLog& log) {
  const schema::Owner me = this_process();
  log.add("run_started", {{"store", std::filesystem::absolute(options.store).string()},
                          {"workers", options.workers},
                          {"threads", options.threads > 0 ? nlohmann::ordered_json(options.threads)
                                                          : nlohmann::ordered_json(nullptr)},
                          {"host", me.host},
                          {"pid", me.pid},
                          {"code_version", code_version()}});
}

// Reports at the very end to the log and to the command of --on-finish, however the run ended.
void announce_end(const RunOptions& options, int exit_code, EventLog& log) {
  RunOutcome outcome{.exit_code = exit_code, .store = options.store};
  try {
    auto jobs = schema::Reader(options.store).job_counts();
    outcome.done = jobs[schema::Status::done];
    outcome.failed = jobs[schema::Status::failed];
    outcome.pending = jobs[schema::Status::pending];
  } catch (const schema::StoreError&) {  // the run has reported it
  }
  log.add("run_ended", {{"exit_code", exit_code},
                        {"done", outcome.done},
                        {"failed", outcome.failed},
                        {"pending", outcome.pending},
                        {"cpu_seconds", cpu_seconds_of_ended_children()}});
  if (!options.on_finish.empty()) run_on_finish(options.on_finish, outcome);
}

}  // namespace

int run(const RunOptions& options) {
  note_stop_signals();
  EventLog log;
  if (!options.log_json.empty()) log.open(options.log_json);
  log_start(options, log);
  int exit_code = exit_failed;
  try {
    schema::Store whole = schema::Store::open(options.store);
    const schema::Choice choice = choice_of(whole, options.where, options.order);
    schema::Selection store(std::move(whole), choice);
    store.wait_for_locks_while(may_wait_for_locks);
    exit_code = work_or_rescue(store, options, log);
  } catch (const std::exception& error) {
    log.add("message", {{"level", "error"}, {"text", error_text(error)}});
    announce_end(options, exit_failed, log);
    throw;
  }
  announce_end(options, exit_code, log);
  return exit_code;
}

}  // namespace haff::campaign
