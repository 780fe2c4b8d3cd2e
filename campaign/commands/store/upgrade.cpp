// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/commands/store/upgrade.hpp"

#include <vector>

#include "campaign/base/output/output.hpp"
#include "campaign/base/process/exit_code.hpp"
#include "campaign/base/text/command_text.hpp"
#include "campaign/run/abandoned.hpp"
#include "schema/store/store.hpp"

namespace haff::campaign {
namespace {

// Leases of jobs whose workers have died: nothing will be written under them any more.
std::vector<schema::Lease> dead_leases(const std::filesystem::path& store) {
  std::vector<schema::Lease> dead;
  for (const schema::RunningJob& job : schema::Reader(store).running())
    if (is_owner_dead(job)) dead.push_back(job.lease);
  return dead;
}

}  // namespace

int upgrade(const std::filesystem::path& store) {
  const int before = schema::Store::upgrade(store, dead_leases(store));
  const int now = schema::newest_version();
  if (before == now)
    say("{}: is of this program's version, {}, already\n", store.string(), now);
  else
    say("{}: brought forward from version {} to {}\n", store.string(), before, now);
  say("Next: {}\n", command_text("run", store));
  return exit_complete;
}

}  // namespace haff::campaign
