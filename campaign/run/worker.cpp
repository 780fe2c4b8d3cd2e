#include "campaign/run/worker.hpp"

#include <fmt/format.h>

#include <chrono>
#include <exception>
#include <new>
#include <optional>
#include <string>
#include <thread>

#include "campaign/base/job_text.hpp"
#include "campaign/base/signals.hpp"
#include "campaign/base/version.hpp"
#include "campaign/job/attempt.hpp"
#include "campaign/job/cooling.hpp"
#include "campaign/job/equilibration.hpp"
#include "campaign/run/process.hpp"
#include "campaign/run/work_left.hpp"
#include "engine/simulation.hpp"
#include "schema/store.hpp"

namespace haff::campaign {
namespace {

using Level = LogReport::Level;

// What a worker with nothing to do waits before it looks again.
constexpr std::chrono::milliseconds idle{100};

std::string name_of(const schema::Claim& claim) {
  return fmt::format("job {} ({})", claim.lease.job_id, describe(claim.job));
}

// Inelastic collapse is not an error, it is where constant e ends.
Ending drive(Attempt& attempt, const Reporter& reporter) try {
  return attempt.job().kind == schema::Kind::equilibration ? equilibrate(attempt) : cool(attempt);
} catch (const engine::Collapse& collapse) {
  const std::string what = fmt::format(
      "{}; a law of \"restitution\" under \"effects\", \"threshold\" or \"tc\", goes on from there",
      collapse.what());
  reporter.send(LogReport{Level::warning, fmt::format("{}: {}", name_of(attempt.claim()), what)});
  return attempt.collapse(what);
}

// What went wrong with the job, nothing if it is done or was left. Errors of the store are not
// the job's fault and are passed on.
std::optional<std::string> error_of(Attempt& attempt, const Reporter& reporter) {
  std::string why;
  try {
    if (drive(attempt, reporter) == Ending::finished)
      reporter.send(LogReport{Level::info, name_of(attempt.claim()) + " done"});
    return std::nullopt;
  } catch (const schema::Damage& damage) {
    why = damage.what();
  } catch (const schema::StoreError&) {
    throw;
  } catch (const std::bad_alloc&) {
    why = "out of memory: run fewer workers";
  } catch (const std::exception& error) {
    why = error.what();
  }
  return fmt::format("{} ({})", why, attempt.place());
}

void fail(schema::Store& store, const schema::Claim& claim, const std::string& error,
          const Reporter& reporter) {
  if (store.fail(claim.lease, error) == schema::Status::failed)
    reporter.send(LogReport{Level::error, fmt::format("{} failed: {}", name_of(claim), error)});
  else
    reporter.send(
        LogReport{Level::warning, fmt::format("{}: attempt {} of {}: {}", name_of(claim),
                                              claim.attempts + 1, schema::max_attempts, error)});
}

void work_on(schema::Store& store, const schema::Claim& claim, const Reporter& reporter) {
  reporter.send(LogReport{Level::debug, name_of(claim) + " begins"});
  Attempt attempt(store, claim, reporter);
  try {
    if (const auto error = error_of(attempt, reporter)) fail(store, claim, *error, reporter);
  } catch (const schema::LeaseLost&) {
    reporter.send(LogReport{Level::warning, name_of(claim) + " belongs to another worker now"});
  }
}

}  // namespace

int work(const std::filesystem::path& path, int report_descriptor) {
  note_stop_signals();
  const Reporter reporter(report_descriptor);
  try {
    schema::Store store = schema::Store::open(path);
    const schema::Owner me = this_process();
    while (stop_signal() == 0) {
      if (const auto claim = store.claim(me, code_version())) {
        work_on(store, *claim, reporter);
        continue;
      }
      reporter.send(IdleReport{});
      if (!may_have_work(store.summary())) return worker_has_finished;
      std::this_thread::sleep_for(idle);
    }
    return worker_was_stopped;
  } catch (const schema::StoreError& error) {
    reporter.send(LogReport{Level::error, error.what()});
    return worker_cannot_use_store;
  }
}

}  // namespace haff::campaign
