#include "campaign/commands/retry.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <vector>

#include "campaign/base/command_text.hpp"
#include "campaign/base/exit_code.hpp"
#include "campaign/base/job_text.hpp"
#include "campaign/base/output.hpp"
#include "campaign/base/printable.hpp"
#include "campaign/commands/json_output.hpp"
#include "campaign/state/restore.hpp"
#include "schema/store.hpp"

namespace haff::campaign {
namespace {

using nlohmann::ordered_json;

// Why the job cannot go on from its state, nor others start from it; or nothing. What is done and
// sound stays, whichever physics version computed it: but for an equilibration, from which others
// start.
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

struct Damaged {
  schema::JobRow row;
  std::string why;
};

// Those whose state is damaged. A single bad read condemns none: what is wrong must be so a second
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
  std::vector<Damaged> damaged;
  try {
    damaged = damaged_jobs(store);
  } catch (const NewerCheckpoint& newer) {
    throw std::runtime_error(
        fmt::format("{}: a newer program wrote one of its states ({}). Nothing was changed; update "
                    "campaign",
                    path.string(), printable(newer.what())));
  }
  int restarted = 0;
  ordered_json list = ordered_json::array();
  for (const auto& [row, why] : damaged) {
    if (!store.restart(row.job_id)) continue;
    ++restarted;
    list.push_back({{"job_id", row.job_id}, {"why", why}});
    if (!json) say("job {} ({}) starts again: {}\n", row.job_id, describe(row.job), printable(why));
  }
  const auto reopened = store.retry_failed();
  if (json) {
    print_json({{"reopened", reopened}, {"restarted", list}});
    return exit_complete;
  }
  say("{} failed job{} reopened, {} with a damaged checkpoint start{} again\n", reopened,
      reopened == 1 ? "" : "s", restarted, restarted == 1 ? "s" : "");
  if (reopened + restarted > 0) say("Next: {}\n", command_text("run", path));
  return exit_complete;
}

}  // namespace haff::campaign
