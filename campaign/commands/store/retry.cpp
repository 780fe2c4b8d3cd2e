// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/commands/store/retry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "campaign/base/output/output.hpp"
#include "campaign/base/process/exit_code.hpp"
#include "campaign/base/text/command_text.hpp"
#include "campaign/base/text/job_text.hpp"
#include "campaign/base/text/printable.hpp"
#include "campaign/commands/json_output.hpp"
#include "campaign/state/restore.hpp"
#include "schema/store/soundness/contradiction.hpp"
#include "schema/store/store.hpp"

namespace haff::campaign {
namespace {

using nlohmann::ordered_json;

// Why the job cannot go on from its state, and others cannot start from it; or nothing. A job that
// is done and sound stays, whichever physics version computed it, unless it is an equilibration,
// from which others start.
std::optional<std::string> damage_of(const schema::Reader& store, const schema::JobRow& row) {
  const bool must_have_state =
      row.job.kind == schema::Kind::equilibration && row.status == schema::Status::done;
  try {
    const auto state = stored_state(store, row.job_id, row.job);
    const bool is_over =
        row.status == schema::Status::done || row.status == schema::Status::collapsed;
    if (state && (must_have_state || !is_over))
      if (auto foreign = foreign_physics(store.checkpoint(row.job_id).value())) return foreign;
    if (!state && must_have_state) return "its state is gone";
    return std::nullopt;
  } catch (const schema::DamagedFile&) {
    throw;
  } catch (const schema::Damage& damage) {
    return damage.what();
  } catch (const DamagedCheckpoint& damage) {
    return damage.what();
  }
}

// The rows of a job that contradict themselves, and what is dropped of them.
struct Contradiction {
  schema::JobRow row;
  double kept_tau = 0;  // up to here they stay
  std::string why;
};

constexpr double nothing = -1;  // kept_tau: not even the sample at 0

std::string parts_text(const std::vector<schema::Part>& parts) {
  std::string text;
  for (const schema::Part part : parts)
    text += (text.empty() ? "" : ", ") + std::string(name(part));
  return text;
}

// Rows that are not as they were written are computed again from the start. A row that came out
// different when it was computed again lies beyond the state from which its job goes on, since rows
// and states are written together. All rows there are dropped, and one computation gives them anew.
std::optional<Contradiction> contradiction_of(const schema::Reader& store,
                                              const schema::JobRow& row) {
  auto wrong = store.digests(row.job_id).wrong;
  std::erase(wrong, schema::Part::jobs);
  if (!wrong.empty())
    return Contradiction{
        row, nothing,
        fmt::format("its {} are not as they were written (their digest)", parts_text(wrong))};
  const bool came_out_different =
      row.error && row.error->find(schema::came_out_different) != std::string::npos;
  if (row.status != schema::Status::failed || !came_out_different) return std::nullopt;
  const double tau = row.starts_over ? nothing : store.stored_tau(row.job_id);
  return Contradiction{row, tau == 0 ? nothing : tau,
                       "they " + std::string(schema::came_out_different)};
}

std::vector<Contradiction> contradictions(const schema::Reader& store) {
  std::vector<Contradiction> found;
  for (const schema::JobRow& row : store.jobs()) {
    if (row.status == schema::Status::running || row.status == schema::Status::lent) continue;
    if (!contradiction_of(store, row)) continue;
    // It must be seen twice, like damage.
    if (auto again = contradiction_of(schema::Reader(store.path()), row))
      found.push_back(*std::move(again));
  }
  return found;
}

// Returns how many jobs begin again.
int drop(schema::Store& store, const std::vector<Contradiction>& contradictions, bool json,
         ordered_json& list) {
  int restarted = 0;
  for (const auto& [row, kept_tau, why] : contradictions) {
    const auto dropped = store.drop_rows_after(row.job_id, kept_tau);
    const std::string what = fmt::format(
        "{} sample{} with all that goes with {} {} dropped, and computed again", dropped,
        dropped == 1 ? "" : "s", dropped == 1 ? "it" : "them", dropped == 1 ? "is" : "are");
    const bool goes_on = kept_tau > 0;
    if (!goes_on && store.restart(row.job_id)) ++restarted;
    list.push_back({{"job_id", row.job_id}, {"why", why}, {"samples_dropped", dropped}});
    if (!json)
      say("job {} ({}) {}: {}: {}\n", row.job_id, describe(row.job),
          goes_on ? fmt::format("goes on from tau = {}", kept_tau) : "starts again", what,
          printable(why));
  }
  return restarted;
}

struct Damaged {
  schema::JobRow row;
  std::string why;
};

// The jobs whose state is damaged. One bad read is not enough: the state must be wrong a second
// time, through a connection that has nothing in memory yet. An error of the system ends the
// command before anything is changed.
std::vector<Damaged> damaged_jobs(const schema::Reader& store) {
  std::vector<Damaged> damaged;
  for (const schema::JobRow& row : store.jobs()) {
    // Other processes work on the first two, and the last is about to be mended.
    if (row.status == schema::Status::running || row.status == schema::Status::lent ||
        row.starts_over)
      continue;
    if (!damage_of(store, row)) continue;
    if (auto why = damage_of(schema::Reader(store.path()), row))
      damaged.push_back({row, *std::move(why)});
  }
  return damaged;
}

}  // namespace

int retry(const std::filesystem::path& path, bool json) {
  schema::Store store = schema::Store::open(path);
  std::vector<Contradiction> contradicted;
  std::vector<Damaged> damaged;
  try {
    contradicted = contradictions(store);
    damaged = damaged_jobs(store);
  } catch (const NewerCheckpoint& newer) {
    throw std::runtime_error(
        fmt::format("{}: a newer program wrote one of its states ({}). Nothing was changed; update "
                    "campaign",
                    path.string(), printable(newer.what())));
  }
  ordered_json list = ordered_json::array();
  int restarted = drop(store, contradicted, json, list);
  for (const Damaged& job : damaged) {
    const schema::JobRow& row = job.row;
    const bool has_begun_again = std::ranges::any_of(contradicted, [&](const Contradiction& each) {
      return each.row.job_id == row.job_id && each.kept_tau <= 0;
    });
    if (has_begun_again || !store.restart(row.job_id)) continue;
    ++restarted;
    list.push_back({{"job_id", row.job_id}, {"why", job.why}});
    if (!json)
      say("job {} ({}) starts again: {}\n", row.job_id, describe(row.job), printable(job.why));
  }
  const auto reopened = store.retry_failed();
  const auto left = store.job_counts()[schema::Status::failed];
  if (json) {
    print_json({{"reopened", reopened}, {"restarted", list}, {"failed", left}});
    return exit_complete;
  }
  say("{} failed job{} reopened, {} with damage start{} again\n", reopened,
      reopened == 1 ? "" : "s", restarted, restarted == 1 ? "s" : "");
  if (left > 0)
    say("{} job{} stay{} failed: the row in the table jobs is not as it was written. Next: {}\n",
        left, left == 1 ? "" : "s", left == 1 ? "s" : "", command_text("verify --repair", path));
  if (reopened + restarted > 0) say("Next: {}\n", command_text("run", path));
  return exit_complete;
}

}  // namespace haff::campaign
