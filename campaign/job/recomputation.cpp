// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/job/recomputation.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <variant>

#include "campaign/base/process/version.hpp"
#include "campaign/job/attempt.hpp"
#include "campaign/job/cooling.hpp"
#include "campaign/job/equilibration.hpp"
#include "engine/simulation.hpp"
#include "schema/digests/checksum.hpp"

namespace haff::campaign {
namespace {

// Reports of progress go nowhere.
class Silence {
 public:
  Silence() : descriptor_(open("/dev/null", O_WRONLY | O_CLOEXEC)), reporter_(descriptor_) {}
  ~Silence() { close(descriptor_); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

  const Reporter& reporter() const { return reporter_; }

 private:
  int descriptor_;
  Reporter reporter_;
};

const schema::Owner this_program{.host = "here", .boot_id = "now", .pid = getpid(), .started = 0};

void must_be_our_physics(const schema::Reader& store, std::int64_t job_id) {
  auto rows =
      store.query(fmt::format("SELECT physics_version FROM jobs WHERE job_id = {}", job_id));
  const auto row = rows.next().value();
  const auto* version = std::get_if<std::int64_t>(row.data());
  if (version && *version != engine::physics_version)
    throw OtherPhysics(fmt::format("was computed with physics version {}, this program's is {}",
                                   *version, engine::physics_version));
}

void run(schema::Store& store) {
  const Silence silence;
  const auto claim = store.claim(this_program, code_version());
  if (!claim) throw std::logic_error("a job to be computed again cannot be claimed");
  Attempt attempt(store, *claim, silence.reporter());
  try {
    if (claim->job.kind == schema::Kind::equilibration)
      equilibrate(attempt);
    else
      cool(attempt);
  } catch (const engine::Collapse& collapse) {
    attempt.collapse(collapse.what());
  }
}

// A row of snapshots holds the checksum of its bytes. Whether they are intact is another question.
std::vector<schema::Difference> damaged_snapshots(const schema::Reader& store,
                                                  const schema::JobRow& row) {
  std::vector<schema::Difference> found;
  auto rows = store.query(
      fmt::format("SELECT time FROM snapshots WHERE job_id = {} ORDER BY time", row.job_id));
  while (const auto snapshot = rows.next()) {
    const double time = std::get<double>(snapshot->front());
    try {
      store.snapshot(row.job_id, time);
    } catch (const schema::Damage&) {
      found.push_back({.part = schema::Part::snapshots,
                       .row = fmt::format("time = {}", time),
                       .column = "state",
                       .here = "damaged",
                       .there = "sound"});
    }
  }
  return found;
}

std::string described(const std::optional<schema::Checkpoint>& state) {
  if (!state) return "none";
  return fmt::format("{} bytes with the checksum {:016x} at tau = {}", state->state.size(),
                     schema::checksum(state->state), state->tau);
}

}  // namespace

Recomputation recompute(const schema::Reader& store, const schema::JobRow& row) {
  if (row.job.kind == schema::Kind::equilibration &&
      row.job.start.kind == schema::Start::Kind::file)
    throw StateWasGiven();
  must_be_our_physics(store, row.job_id);
  Recomputation again{.store = schema::Store::in_memory()};
  if (row.equilibration_id) again.store.take_over(store, *row.equilibration_id);
  again.store.add(std::vector<schema::Planned>{
      {.job = row.job, .tau_max = row.tau_max, .checkpoint_every = row.checkpoint_every}});
  run(again.store);
  again.job_id = again.store.find(row.job).value();
  return again;
}

std::vector<schema::Difference> differences(const schema::Reader& store, const schema::JobRow& row,
                                            const Recomputation& again) {
  using schema::Part;
  std::vector<schema::Difference> all;
  for (const Part part : computed_parts) {
    const auto found = store.differences(row.job_id, part, again.store, again.job_id);
    all.insert(all.end(), found.begin(), found.end());
  }
  for (const schema::Difference& damaged : damaged_snapshots(store, row)) all.push_back(damaged);
  if (row.job.kind == schema::Kind::equilibration) {
    std::optional<schema::Checkpoint> here;
    try {
      here = store.checkpoint(row.job_id);
    } catch (const schema::Damage&) {  // differs, whatever it is
    }
    const auto there = again.store.checkpoint(again.job_id);
    if (!here || !there || here->state != there->state || here->tau != there->tau)
      all.push_back({.part = Part::checkpoints,
                     .row = {},
                     .column = "state",
                     .here = described(here),
                     .there = described(there)});
  }
  return all;
}

}  // namespace haff::campaign
