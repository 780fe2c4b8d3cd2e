// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/run/worker.hpp"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include "campaign/base/process/signals.hpp"
#include "campaign/base/process/version.hpp"
#include "campaign/base/process/would_fail_again.hpp"
#include "campaign/base/text/error_text.hpp"
#include "campaign/base/text/job_text.hpp"
#include "campaign/job/attempt.hpp"
#include "campaign/job/cooling.hpp"
#include "campaign/job/equilibration.hpp"
#include "campaign/run/process.hpp"
#include "campaign/run/threads_now.hpp"
#include "campaign/run/work_left.hpp"
#include "engine/simulation.hpp"
#include "schema/store/store.hpp"

namespace haff::campaign {
namespace {

using Level = LogReport::Level;

// How long a worker with nothing to do waits before it looks again. It only reads then: an idle
// worker takes no write lock.
constexpr std::chrono::milliseconds idle{100};

// Expected CPU times hold for this machine when it is not busy, and for a gas before it clusters.
constexpr double margin = 1.5;

// Returns when the store is no longer as it was `seen`, or when asked to stop.
void wait_for_change(const schema::Store& store, std::int64_t seen) {
  while (stop_signal() == 0 && store.change_counter() == seen) std::this_thread::sleep_for(idle);
}

std::string name_of(const schema::Claim& claim) {
  return fmt::format("job {} ({})", claim.lease.job_id, describe(claim.job));
}

// Inelastic collapse is no error: it is where the model of a constant e ends.
Ending drive(Attempt& attempt, const Reporter& reporter) try {
  return attempt.job().kind == schema::Kind::equilibration ? equilibrate(attempt) : cool(attempt);
} catch (const engine::Collapse& collapse) {
  const std::string what = fmt::format(
      "{}; a law of \"restitution\" under \"effects\", \"threshold\" or \"tc\", goes on from there",
      collapse.what());
  reporter.send(LogReport{Level::warning, fmt::format("{}: {}", name_of(attempt.claim()), what),
                          "job_collapsed", attempt.claim().lease.job_id});
  return attempt.collapse(what);
}

struct Failure {
  std::string why;
  bool again = true;  // another attempt may succeed
};

// What went wrong with the job; nothing if it is done or was left. Errors of the store have other
// causes than the job and are passed on.
std::optional<Failure> failure_of(Attempt& attempt, const Reporter& reporter) {
  std::string why;
  bool again = true;
  try {
    if (drive(attempt, reporter) == Ending::finished)
      reporter.send(LogReport{Level::info, name_of(attempt.claim()) + " done", "job_done",
                              attempt.claim().lease.job_id});
    return std::nullopt;
  } catch (const schema::DamagedFile&) {
    throw;
  } catch (const schema::Damage& damage) {
    why = error_text(damage);
  } catch (const schema::StoreError&) {
    throw;
  } catch (const std::bad_alloc&) {
    why = "out of memory: run fewer workers";
  } catch (const std::invalid_argument& error) {  // a gas that is impossible, however often tried
    why = fmt::format("{}; {}", error.what(), would_fail_again);
    again = false;
  } catch (const NotEquilibrated& error) {
    why = fmt::format("{}; {}", error.what(), would_fail_again);
    again = false;
  } catch (const std::exception& error) {
    why = error.what();
  }
  return Failure{fmt::format("{} ({})", why, attempt.place()), again};
}

void fail(schema::Store& store, const schema::Claim& claim, const Failure& failure,
          const Reporter& reporter) {
  const std::string& error = failure.why;
  if (store.fail(claim.lease, error, failure.again) == schema::Status::failed)
    reporter.send(LogReport{Level::error, fmt::format("{} failed: {}", name_of(claim), error),
                            "job_failed", claim.lease.job_id});
  else
    reporter.send(LogReport{Level::warning,
                            fmt::format("{}: attempt {} of {}: {}", name_of(claim),
                                        claim.attempts + 1, schema::max_attempts, error),
                            "attempt_failed", claim.lease.job_id});
}

void work_on(schema::Selection& store, const schema::Claim& claim, const Reporter& reporter,
             const ThreadShare& share) {
  reporter.send(
      LogReport{Level::debug, name_of(claim) + " begins", "job_begun", claim.lease.job_id});
  Attempt attempt(store, claim, reporter, [&] { return threads_now(claim.job, share, store); });
  try {
    if (const auto failure = failure_of(attempt, reporter)) fail(store, claim, *failure, reporter);
  } catch (const schema::LeaseLost&) {
    reporter.send(LogReport{Level::warning, name_of(claim) + " belongs to another worker now",
                            "job_lost", claim.lease.job_id});
  }
}

// The holes that a large gas leaves in the heap do not hold the next one: three gases of 150 000
// would take half as much again as one. Small jobs are over sooner than this. [particles]
void give_memory_back(std::uint32_t particles) {
  constexpr std::uint32_t large = 5000;
#ifdef __GLIBC__
  if (particles >= large) malloc_trim(0);
#endif
}

}  // namespace

std::optional<schema::Fit> what_fits(std::optional<Deadline> deadline) {
  if (!deadline) return std::nullopt;
  const std::chrono::duration<double> left = *deadline - std::chrono::steady_clock::now();
  return schema::Fit{.seconds = std::max(0.0, left.count()) / margin,
                     .tau = engine::synchronization_period};
}

std::optional<double> least_seconds_needed(const schema::Selection& store) {
  const auto expected = store.least_seconds_to(engine::synchronization_period);
  return expected ? std::optional(margin * *expected) : std::nullopt;
}

int work(const std::filesystem::path& path, int report_descriptor, const WorkerOptions& options) {
  note_stop_signals();
  const Reporter reporter(report_descriptor);
  try {
    schema::Store whole = schema::Store::open(path);
    const schema::Choice choice(whole, options.where, options.order);
    schema::Selection store(std::move(whole), choice);
    store.wait_for_locks_while(may_wait_for_locks);
    const schema::Owner me = this_process();
    while (stop_signal() == 0) {
      const std::int64_t seen = store.change_counter();  // before the look that it is to guard
      const auto fit = what_fits(options.deadline);
      if (store.has_claimable(fit)) {
        if (const auto claim = store.claim(me, code_version(), fit)) {
          work_on(store, *claim, reporter, options.share);
          give_memory_back(claim->job.particles);
        }
        continue;
      }
      reporter.send(IdleReport{});
      const schema::Summary summary = store.summary();
      if (!may_have_work(summary)) return worker_has_finished;
      if (options.deadline && summary.waiting == 0 && summary.claimable > 0 &&
          !store.has_claimable(what_fits(options.deadline)))
        return worker_has_no_time;
      wait_for_change(store, seen);
    }
    return worker_was_stopped;
  } catch (const schema::Locked& error) {
    // It was asked to stop while another process held the store: the next run takes the job back.
    if (stop_signal() != 0) return worker_was_stopped;
    reporter.send(LogReport{Level::error, error_text(error)});
    return worker_cannot_use_store;
  } catch (const schema::StoreError& error) {
    reporter.send(LogReport{Level::error, error_text(error)});
    return worker_cannot_use_store;
  }
}

}  // namespace haff::campaign
