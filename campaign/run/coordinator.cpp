// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/run/coordinator.hpp"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "campaign/base/process/cpu_time.hpp"
#include "campaign/base/process/signals.hpp"
#include "campaign/base/text/job_text.hpp"
#include "campaign/base/text/number_text.hpp"
#include "campaign/run/abandoned.hpp"
#include "campaign/run/display.hpp"
#include "campaign/run/ledger.hpp"
#include "campaign/run/worker.hpp"
#include "campaign/run/worker_process.hpp"

namespace haff::campaign {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using Level = LogReport::Level;

constexpr auto listen_for = 100ms;     // at most, before other tasks are attended to
constexpr auto look_after_store = 1s;  // dead owners, progress of other runs
constexpr auto log_progress_every = 10s;
constexpr auto grace = 5s;  // to leave in order; a transaction cut short is undone

// A log that is copied each second stays smaller than this, the largest commits of a second.
// [bytes]
constexpr std::int64_t remarkable_log = std::int64_t{64} << 20;

// Workers that die again and again without a job would do so the next time, too.
constexpr int hopeless = 5;

// Kills in a row, without progress, that do not cost a job an attempt.
constexpr int excused_kills = 10;

std::string_view name(Level level) {
  switch (level) {
    case Level::debug:
      return "debug";
    case Level::info:
      return "info";
    case Level::warning:
      return "warning";
    case Level::error:
      return "error";
  }
  return "error";
}

std::optional<Deadline> deadline_of(const RunOptions& options, Clock::time_point start) {
  if (!options.max_seconds) return std::nullopt;
  return Deadline(start) + std::chrono::duration<double>(*options.max_seconds);
}

class Coordinator {
 public:
  Coordinator(schema::Selection& store, const RunOptions& options, Clock::time_point start,
              std::size_t workers, EventLog& log)
      : store_(store),
        options_(options),
        start_(start),
        log_(log),
        display_(workers),
        ledger_(store),
        workers_(workers),
        has_finished_(workers) {}

  // Returns when all workers have ended.
  void run() {
    look_after_abandoned();
    start_workers();
    while (is_anyone_alive()) {
      listen();
      reap_the_dead();
      look_after_time();
      if (!is_stopping()) start_workers();
      if (!is_stopping() && Clock::now() - looked_ >= look_after_store) {
        look_after_file();
        look_after_abandoned();
        ledger_.refresh(store_);
      }
      if (display_.is_due()) display_.show(ledger_.totals());
      log_progress();
    }
  }

  RoundEnd end() const { return end_; }

 private:
  bool is_stopping() const { return stopping_since_.has_value(); }

  // Reports to people, and to the log for programs.
  void tell(const LogReport& what) {
    display_.log(what.level, what.text);
    if (!log_.is_open()) return;
    nlohmann::ordered_json fields{{"level", name(what.level)}, {"text", what.text}};
    if (what.job_id) fields["job_id"] = *what.job_id;
    log_.add(what.event, fields);
  }
  void tell(Level level, const std::string& text, const char* event = "message",
            std::optional<std::int64_t> job_id = {}) {
    tell(LogReport{level, text, event, job_id});
  }

  void log_progress() {
    if (!log_.is_open() || Clock::now() - progress_logged_ < log_progress_every) return;
    progress_logged_ = Clock::now();
    const Totals totals = ledger_.totals();
    nlohmann::ordered_json fields{
        {"jobs", totals.jobs},     {"done", totals.done},
        {"failed", totals.failed}, {"fraction", totals.fraction},
        {"seconds_left", nullptr}, {"running", nlohmann::ordered_json::array()}};
    if (totals.seconds_left) fields["seconds_left"] = *totals.seconds_left;
    for (const auto& [worker, report] : at_work_)
      fields["running"].push_back({{"worker", worker},
                                   {"job_id", report.job_id},
                                   {"tau_reached", report.tau},
                                   {"tau_max", report.tau_max},
                                   {"collisions_per_second", report.collisions_per_second}});
    log_.add("progress", fields);
  }

  void set(std::size_t worker, const std::optional<ProgressReport>& report) {
    display_.set(worker, report);
    if (report)
      at_work_[worker] = *report;
    else
      at_work_.erase(worker);
  }

  bool is_anyone_alive() const {
    return std::any_of(workers_.begin(), workers_.end(),
                       [](const auto& worker) { return worker != nullptr; });
  }

  void start_workers() {
    for (std::size_t k = 0; k < workers_.size(); ++k)
      if (!workers_[k] && !has_finished_[k])
        workers_[k] = std::make_unique<WorkerProcess>(
            options_.store,
            WorkerOptions{.deadline = deadline_of(options_, start_),
                          .share = {.threads = options_.threads, .processors = options_.workers},
                          .where = options_.where,
                          .order = options_.order});
  }

  void listen() {
    std::vector<pollfd> pipes;
    for (const auto& worker : workers_)
      if (worker) pipes.push_back({worker->report_descriptor(), POLLIN, 0});
    poll(pipes.data(), pipes.size(), std::chrono::milliseconds(listen_for).count());
    for (std::size_t k = 0; k < workers_.size(); ++k)
      if (workers_[k]) take_reports(k);
  }

  void take_reports(std::size_t k) {
    for (const Report& report : workers_[k]->take_reports()) {
      if (const auto* progress = std::get_if<ProgressReport>(&report)) {
        crashes_without_job_ = 0;
        ledger_.note(*progress);
        set(k, *progress);
      } else if (const auto* log = std::get_if<LogReport>(&report)) {
        tell(*log);
      } else {
        set(k, std::nullopt);
      }
    }
  }

  void reap_the_dead() {
    for (std::size_t k = 0; k < workers_.size(); ++k) {
      if (!workers_[k] || !workers_[k]->has_ended()) continue;
      take_reports(k);
      set(k, std::nullopt);
      const auto held = held_by(workers_[k]->identity());
      const WorkerProcess::End end = workers_[k]->reap();
      workers_[k].reset();
      if (end.is_exit(worker_has_finished)) {
        has_finished_[k] = true;
      } else if (end.is_exit(worker_has_no_time)) {
        has_finished_[k] = true;
        note_lack_of_time();
      } else if (end.is_exit(worker_cannot_use_store)) {
        end_.store_error = true;
        give_back(held);
        stop(SIGTERM);
      } else if (end.is_exit(worker_was_stopped)) {
        // It was stopped by us, or by a signal to this worker alone: then it is replaced.
        give_back(held);
      } else {
        charge(held, end);
      }
    }
  }

  void note_lack_of_time() {
    end_.over_limit = true;
    end_.seconds_needed = least_seconds_needed(store_);
  }

  std::vector<schema::RunningJob> held_by(const schema::Owner& worker) const {
    auto jobs = store_.running();
    std::erase_if(jobs, [&](const schema::RunningJob& job) { return job.owner != worker; });
    return jobs;
  }

  // A crash costs the job an attempt, unless the coordinator killed the worker to stop in time.
  void charge(const std::vector<schema::RunningJob>& held, const WorkerProcess::End& end) {
    if (held.empty()) look_out_for_hopelessness(end);
    for (const schema::RunningJob& job : held) {
      if (end.killed_by_us || is_stopping()) {
        tell(Level::info,
             fmt::format("job {} ({}): {}; it goes on from its last checkpoint", job.lease.job_id,
                         describe(job.job), end.text()),
             "worker_ended", job.lease.job_id);
        continue;
      }
      const std::string error =
          fmt::format("{} (seed {}, after tau {:.6g}, {} collisions)", end.text(), job.job.seed,
                      job.progress.tau, job.progress.collisions);
      const bool is_excused = end.signal == SIGKILL && excuses_kill(job);
      const bool for_good = is_excused ? give_back(job.lease) : fail(job.lease, error);
      tell(for_good ? Level::error : Level::warning,
           fmt::format("job {} ({}){}: {}", job.lease.job_id, describe(job.job),
                       for_good ? " failed" : "", error),
           for_good ? "job_failed" : "worker_died", job.lease.job_id);
    }
    if (end.killed_by_us || is_stopping()) give_back(held);
  }

  void look_out_for_hopelessness(const WorkerProcess::End& end) {
    if (is_stopping() || end.signal == SIGKILL || ++crashes_without_job_ < hopeless) return;
    throw std::runtime_error(fmt::format(
        "workers end before they take a job: {}; run again with --verbose", end.text()));
  }

  // SIGKILL comes from outside, from a person or a machine that shuts down, and says little about
  // the job. Only where workers of a job are killed again and again while it gets no further may
  // the job itself be the reason, by the memory that it takes.
  bool excuses_kill(const schema::RunningJob& job) {
    Kills& kills = kills_[job.lease.job_id];
    const double tau = store_.stored_tau(job.lease.job_id);
    if (tau > kills.tau) kills = {.tau = tau, .count = 0};
    return ++kills.count <= excused_kills;
  }

  // Stores what a worker could not store any more. If this fails too, the next run does it.
  void give_back(const std::vector<schema::RunningJob>& held) {
    try {
      for (const schema::RunningJob& job : held) store_.reclaim(job.lease);
    } catch (const schema::StoreError&) {
    }
  }

  bool give_back(const schema::Lease& lease) {
    store_.reclaim(lease);
    return false;
  }

  bool fail(const schema::Lease& lease, const std::string& error) {
    try {
      return store_.fail(lease, error) == schema::Status::failed;
    } catch (const schema::LeaseLost&) {
      return false;  // another run has already taken it
    }
  }

  // Jobs of this run are seen to when their workers are reaped.
  void look_after_abandoned() {
    looked_ = Clock::now();
    for (const schema::RunningJob& job : store_.running()) {
      if (is_mine(job.owner) || !leases_.is_abandoned(job) || !store_.reclaim(job.lease)) continue;
      tell(Level::info,
           fmt::format("job {} ({}): its owner, process {} on {}, is gone; taken back",
                       job.lease.job_id, describe(job.job), job.owner.pid, job.owner.host),
           "job_taken_back", job.lease.job_id);
    }
  }

  // Looks whether the store is still where it was, and keeps its log small.
  void look_after_file() {
    if (const auto what = store_.displaced()) {
      tell(Level::error, fmt::format("{} {}; stopping", store_.path().string(), *what), "stopping");
      end_.store_error = true;
      stop(SIGTERM);
      return;
    }
    const schema::LogSize log = store_.copy_log();
    if (log.is_copied || log.bytes < remarkable_log || has_warned_of_log_) return;
    has_warned_of_log_ = true;
    tell(Level::warning,
         fmt::format("{}-wal has grown to {} and grows on, since another program has been "
                     "reading the store for long: end its query",
                     store_.path().string(), bytes_text(static_cast<double>(log.bytes))));
  }

  bool is_mine(const schema::Owner& owner) const {
    return std::any_of(workers_.begin(), workers_.end(),
                       [&](const auto& worker) { return worker && worker->identity() == owner; });
  }

  void look_after_time() {
    const auto now = Clock::now();
    if (!is_stopping() && stop_signal() != 0) {
      tell(Level::info, "stopping: workers store what they can (once more to stop at once)",
           "stopping");
      stop(SIGTERM);
    }
    if (!is_stopping() && options_.max_seconds &&
        now - start_ > std::chrono::duration<double>(*options_.max_seconds)) {
      end_.over_limit = true;
      tell(Level::info, "stopping: --max-time is over; workers go on to where they can store",
           "stopping");
      stop(SIGUSR1);
    }
    if (!is_stopping() && options_.cpu_budget && cpu_spent() > *options_.cpu_budget) {
      end_.over_limit = true;
      tell(Level::info, "stopping: --budget is spent; workers go on to where they can store",
           "stopping");
      stop(SIGUSR1);
    }
    // At a limit each worker goes on to where its gas can be stored; a signal does not wait long.
    if (is_stopping() && stop_signal() != 0) stop(SIGTERM);
    if (hurried_since_ && (stop_signals() > 1 || now - *hurried_since_ > grace))
      for (const auto& worker : workers_)
        if (worker) worker->kill_now();
  }

  double cpu_spent() const {
    double sum = cpu_seconds_of_ended_children();
    for (const auto& worker : workers_)
      if (worker) sum += cpu_seconds_of(static_cast<pid_t>(worker->identity().pid));
    return sum;
  }

  // SIGTERM: workers have `grace` to store what they can. SIGUSR1: as long as it takes to the next
  // synchronization, so that nothing is lost to a limit.
  void stop(int signal) {
    if (hurried_since_ || (signal == SIGUSR1 && is_stopping())) return;
    if (!is_stopping()) stopping_since_ = Clock::now();
    if (signal == SIGTERM) hurried_since_ = Clock::now();
    for (const auto& worker : workers_)
      if (worker) worker->signal(signal);
  }

  schema::Selection& store_;
  const RunOptions& options_;
  Clock::time_point start_;  // of the run; this may be a later round of it
  EventLog& log_;
  std::map<std::size_t, ProgressReport> at_work_;  // by worker
  Clock::time_point progress_logged_;
  Display display_;
  Ledger ledger_;
  std::vector<std::unique_ptr<WorkerProcess>> workers_;
  std::vector<bool> has_finished_;
  int crashes_without_job_ = 0;
  struct Kills {
    double tau = 0;
    int count = 0;
  };
  std::map<std::int64_t, Kills> kills_;  // by job
  RoundEnd end_;
  LeaseWatch leases_;
  bool has_warned_of_log_ = false;
  std::optional<Clock::time_point> stopping_since_, hurried_since_;
  Clock::time_point looked_;
};

}  // namespace

RoundEnd run_round(schema::Selection& store, const RunOptions& options,
                   std::chrono::steady_clock::time_point start, EventLog& log) {
  const schema::Summary before = store.summary();
  const auto running = before.jobs.at(schema::Status::running);
  const auto useful = before.claimable + before.waiting + running;
  if (useful == 0) return {};
  // No job is begun if nothing of it could be stored.
  const auto fit = what_fits(deadline_of(options, start));
  if (fit && running == 0 && before.claimable > 0 && !store.has_claimable(fit))
    return {.over_limit = true, .seconds_needed = least_seconds_needed(store)};
  const auto workers = std::min<std::int64_t>(options.workers, useful);
  Coordinator coordinator(store, options, start, static_cast<std::size_t>(workers), log);
  coordinator.run();
  return coordinator.end();
}

}  // namespace haff::campaign
