// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/report/explanation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "campaign/base/text/command_text.hpp"
#include "campaign/base/text/duration.hpp"
#include "campaign/base/text/job_text.hpp"
#include "campaign/base/text/number_text.hpp"
#include "campaign/base/text/printable.hpp"
#include "campaign/cluster/division.hpp"
#include "campaign/run/abandoned.hpp"

namespace haff::campaign {
namespace {

using nlohmann::ordered_json;
using schema::JobRow;
using schema::Reader;
using schema::Status;

std::string command(const Reader& store, const std::string& words) {
  return "`" + command_text(words, store.path()) + "`";
}

std::string plural(std::int64_t count, const char* one, const char* many) {
  return fmt::format("{} {}", count_text(count), count == 1 ? one : many);
}

const schema::RunningJob* running_as(const std::vector<schema::RunningJob>& running,
                                     std::int64_t job_id) {
  const auto found = std::ranges::find_if(
      running, [&](const schema::RunningJob& job) { return job.lease.job_id == job_id; });
  return found == running.end() ? nullptr : &*found;
}

// The shards that hold the job and are out, as "shard-001 (shards/shard-001.db)".
std::vector<std::string> holders(const Reader& store, std::int64_t job_id) {
  auto rows = store.query(
      fmt::format("SELECT shard, path FROM loans JOIN shards USING (shard) WHERE job_id = {} AND "
                  "returned IS NULL ORDER BY shard",
                  job_id));
  std::vector<std::string> shards;
  while (const auto row = rows.next())
    shards.push_back(fmt::format("{} ({})", std::get<std::string>(row->at(0)),
                                 std::get<std::string>(row->at(1))));
  return shards;
}

// ---- where ------------------------------------------------------------------------------------

std::vector<std::string> where_is(const Reader& store, const JobRow& row,
                                  const schema::RunningJob* running) {
  std::vector<std::string> lines;
  const std::string meaning(
      std::ranges::find(schema::statuses, row.status, &schema::StatusEntry::status)->meaning);
  lines.push_back(fmt::format("It is {}: {}.", name(row.status), meaning));
  lines.push_back(fmt::format("It has reached tau = {:.6g} of {}, {} collisions.", row.progress.tau,
                              number_text(row.tau_max), count_text(row.progress.collisions)));
  if (running != nullptr) {
    lines.push_back(fmt::format("Process {} on {} works on it; its last sign of life: {}.",
                                running->owner.pid, running->owner.host, running->renewed));
    if (is_owner_dead(*running)) lines.emplace_back("That process is gone.");
  } else if (row.host) {
    lines.push_back(fmt::format("It was last worked on by {}, with campaign {}.", *row.host,
                                row.code_version.value_or("of an unknown version")));
  }
  if (row.status == Status::lent)
    for (const std::string& shard : holders(store, row.job_id))
      lines.push_back(fmt::format("It is lent to {}.", shard));
  return lines;
}

// ---- what it waits for ------------------------------------------------------------------------

// Jobs that a run would take before it: equilibrations first, then those with the most to do.
std::int64_t ahead_of(const std::vector<JobRow>& jobs, const JobRow& row) {
  const auto is_equilibration = [](const JobRow& job) {
    return job.job.kind == schema::Kind::equilibration;
  };
  return std::ranges::count_if(jobs, [&](const JobRow& other) {
    if (other.status != Status::pending || other.job_id == row.job_id) return false;
    if (is_equilibration(other) != is_equilibration(row)) return is_equilibration(other);
    return remaining_cpu_seconds(other) > remaining_cpu_seconds(row);
  });
}

std::vector<std::string> waits_for(const Reader& store, const JobRow& row) {
  std::vector<std::string> lines;
  if (row.status != Status::pending) return lines;
  if (row.equilibration_id) {
    const JobRow start = store.job(*row.equilibration_id);
    if (start.status != Status::done)
      lines.push_back(fmt::format(
          "Its equilibration, job {}, which is {}{}.", start.job_id, name(start.status),
          start.status == Status::running
              ? fmt::format(" (tau = {:.6g} of {})", start.progress.tau, number_text(start.tau_max))
              : ""));
  }
  if (!lines.empty()) return lines;
  const auto running = store.running();
  const std::int64_t ahead = ahead_of(store.jobs(), row);
  const auto at_work = std::ranges::count_if(
      running, [](const schema::RunningJob& job) { return !is_owner_dead(job); });
  if (at_work == 0)
    lines.push_back(
        fmt::format("A run: no process works on this store. {} would be taken before it.",
                    plural(ahead, "job", "jobs")));
  else
    lines.push_back(fmt::format("A free worker: {} at work, and {} would be taken before it.",
                                at_work == 1 ? std::string("one is") : plural(at_work, "is", "are"),
                                plural(ahead, "job", "jobs")));
  return lines;
}

// ---- what was tried ---------------------------------------------------------------------------

std::vector<std::string> what_was_tried(const Reader& store, const JobRow& row) {
  std::vector<std::string> lines;
  if (!row.started) {
    lines.emplace_back("Nothing yet: no worker has taken it.");
    return lines;
  }
  lines.push_back(fmt::format(
      "It was first taken on {}; {} of CPU time were spent on it{}.", *row.started,
      duration_text(row.progress.cpu_seconds),
      row.expected_cpu_seconds
          ? fmt::format(", {} were expected in all", duration_text(*row.expected_cpu_seconds))
          : ""));
  if (row.finished) lines.push_back(fmt::format("It ended on {}.", *row.finished));
  if (row.attempts > 0)
    lines.push_back(fmt::format("{} in a row ended in an error; {} are allowed.",
                                plural(row.attempts, "attempt", "attempts"), schema::max_attempts));
  if (row.error) lines.push_back(fmt::format("Its last error: {}", printable(*row.error)));
  const double stored = store.stored_tau(row.job_id);
  if (row.status != Status::done && stored > 0)
    lines.push_back(
        row.starts_over
            ? fmt::format("Its state at tau = {:.6g} is damaged and is not used.", stored)
            : fmt::format("Its state at tau = {:.6g} is stored.", stored));
  return lines;
}

// ---- what comes next --------------------------------------------------------------------------

// Whether the equilibration it starts from has failed.
bool is_blocked(const Reader& store, const JobRow& row) {
  return row.equilibration_id && store.job(*row.equilibration_id).status == Status::failed;
}

std::string goes_on(const Reader& store, const JobRow& row) {
  const double stored = row.starts_over ? 0 : store.stored_tau(row.job_id);
  return stored > 0 ? fmt::format("goes on from tau = {:.6g}", stored) : "begins at its start";
}

std::vector<std::string> what_comes_next(const Reader& store, const JobRow& row,
                                         const schema::RunningJob* running) {
  std::vector<std::string> lines;
  const double left = remaining_cpu_seconds(row);
  switch (row.status) {
    case Status::pending:
      if (is_blocked(store, row)) {
        lines.push_back(fmt::format("{} reopens the equilibration, and {} goes on.",
                                    command(store, "retry"), command(store, "run")));
        break;
      }
      lines.push_back(fmt::format("The next worker of {} that is free for it {}.",
                                  command(store, "run"), goes_on(store, row)));
      if (row.attempts > 0)
        lines.push_back(
            fmt::format("After {} more it is failed.",
                        plural(schema::max_attempts - row.attempts, "error", "errors")));
      lines.push_back(fmt::format("Some {} of CPU time are left.", duration_text(left)));
      break;
    case Status::running:
      if (running != nullptr && is_owner_dead(*running))
        lines.push_back(fmt::format("The next {} takes it back, and it {}.", command(store, "run"),
                                    goes_on(store, row)));
      else
        lines.push_back(fmt::format("It goes on for some {}; its results are then committed.",
                                    duration_text(left)));
      break;
    case Status::lent:
      lines.push_back(fmt::format("Run the shard, then {}; or take the job back with {}.",
                                  command(store, "merge SHARD.db"),
                                  command(store, "recall SHARD")));
      break;
    case Status::done:
      lines.emplace_back(
          "Nothing. A grid that is planned with a larger tau_max would take it up again.");
      break;
    case Status::failed:
      lines.push_back(fmt::format("Nothing, until {} reopens it; {} then tries again, and it {}.",
                                  command(store, "retry"), command(store, "run"),
                                  goes_on(store, row)));
      break;
    case Status::collapsed:
      lines.emplace_back(
          "Nothing: constant restitution ends here. A law of \"restitution\" under \"effects\" "
          "goes "
          "on from there.");
      break;
  }
  return lines;
}

// The jobs that cannot begin before this one is done.
std::optional<std::string> waiting_for_it(const Reader& store, const JobRow& row) {
  auto rows = store.query(fmt::format(
      "SELECT count(*) FROM jobs WHERE equilibration_id = {} AND status = 'pending'", row.job_id));
  const auto count = std::get<std::int64_t>(rows.next().value().at(0));
  if (count == 0 || row.status == Status::done) return std::nullopt;
  return fmt::format("{} for it.", plural(count, "cooling job waits", "cooling jobs wait"));
}

}  // namespace

Explanation explain(const Reader& store, std::int64_t job_id) {
  const JobRow row = store.job(job_id);
  const auto running = store.running();
  const schema::RunningJob* now = running_as(running, job_id);
  Explanation found{.row = row,
                    .where = where_is(store, row, now),
                    .waits_for = waits_for(store, row),
                    .tried = what_was_tried(store, row),
                    .next = what_comes_next(store, row, now)};
  if (const auto others = waiting_for_it(store, row)) found.where.push_back(*others);
  return found;
}

ordered_json explanation_json(const Explanation& explanation) {
  const JobRow& row = explanation.row;
  return {{"job_id", row.job_id},
          {"job", describe(row.job)},
          {"kind", name(row.job.kind)},
          {"status", name(row.status)},
          {"tau_reached", row.progress.tau},
          {"tau_max", row.tau_max},
          {"attempts", row.attempts},
          {"error", row.error ? ordered_json(*row.error) : ordered_json(nullptr)},
          {"cpu_seconds", row.progress.cpu_seconds},
          {"where", explanation.where},
          {"waits_for", explanation.waits_for},
          {"tried", explanation.tried},
          {"next", explanation.next}};
}

}  // namespace haff::campaign
