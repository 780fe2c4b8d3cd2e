#include "campaign/commands/retry.hpp"

#include <fmt/format.h>

#include "campaign/base/command_text.hpp"
#include "campaign/base/exit_code.hpp"
#include "campaign/base/job_text.hpp"
#include "campaign/base/output.hpp"
#include "campaign/base/printable.hpp"
#include "campaign/state/restore.hpp"
#include "schema/store.hpp"

namespace haff::campaign {
namespace {

// Why the job cannot go on from its checkpoint, nor others start from it; or nothing.
std::optional<std::string> damage_of(const schema::Store& store, const schema::JobRow& row) {
  const bool must_have_state =
      row.job.kind == schema::Kind::equilibration && row.status == schema::Status::done;
  try {
    const auto checkpoint = store.checkpoint(row.job_id);
    if (checkpoint) restore(*checkpoint, row.job);
    if (!checkpoint && must_have_state) return "its state is gone";
    return std::nullopt;
  } catch (const schema::Damage& damage) {
    return damage.what();
  } catch (const DamagedCheckpoint& damage) {
    return damage.what();
  }
}

}  // namespace

int retry(const std::filesystem::path& path) {
  schema::Store store = schema::Store::open(path);
  int restarted = 0;
  for (const schema::JobRow& row : store.jobs()) {
    if (row.status == schema::Status::running) continue;
    const auto damage = damage_of(store, row);
    if (!damage || !store.restart(row.job_id)) continue;
    ++restarted;
    say("job {} ({}) starts again: {}\n", row.job_id, describe(row.job), printable(*damage));
  }
  const auto reopened = store.retry_failed();
  say("{} failed job{} reopened, {} with a damaged checkpoint start{} again\n", reopened,
      reopened == 1 ? "" : "s", restarted, restarted == 1 ? "s" : "");
  if (reopened + restarted > 0) say("Next: {}\n", command_text("run", path));
  return exit_complete;
}

}  // namespace haff::campaign
