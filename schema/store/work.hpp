// SPDX-License-Identifier: GPL-3.0-or-later

// What is planned, which process works on it, and what a worker commits.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "schema/grid/job.hpp"
#include "schema/rows/measured.hpp"

namespace haff::schema {

// Errors in a row, with no new checkpoint between them, after which a job is failed for good.
inline constexpr int max_attempts = 3;

// ---- planning ---------------------------------------------------------------------------------

struct Planned {
  Job job;
  double tau_max = 0;
  double checkpoint_every = 10;
  std::optional<double> expected_cpu_seconds = {};  // to reach tau_max from the start
  // The state that a start from a file is: its equilibration is then done, and holds it.
  std::shared_ptr<const Checkpoint> given_state = {};
};

// What became, or would become, of one planned job. extended: it was there with a smaller
// tau_max, which is now the larger one; done jobs are pending again. A collapsed job stays as it
// is.
enum class Outcome { added, extended, unchanged };

// ---- working ----------------------------------------------------------------------------------

// A process, distinguished from all others that ever had its number.
struct Owner {
  std::string host;
  std::string boot_id;  // changes when the host restarts
  std::int64_t pid = 0;
  std::int64_t started = 0;  // process start time, clock ticks since boot

  bool operator==(const Owner&) const = default;
};

// The right to write to a job. The token grows with every claim, so that an old holder is known.
struct Lease {
  std::int64_t job_id = 0;
  std::int64_t token = 0;
};

// The condition that a job can store something in the time that is left: that it is expected to get
// so much further, or to its end, within these seconds.
struct Fit {
  double seconds = 0;  // of CPU time
  double tau = 0;
};

struct Claim {
  Lease lease;
  Job job;
  double tau_max = 0;
  double checkpoint_every = 0;
  std::optional<std::int64_t> equilibration_id;  // a cooling job's; its checkpoint is the start
  int attempts = 0;                              // errors in a row so far
  double cpu_seconds = 0;                        // spent on it before
  bool starts_over = false;                      // its state is damaged: begin at the start
};

// What a worker writes in one transaction: what was measured before the checkpoint, and the
// checkpoint itself, so that the store never has one without the other.
struct Commit {
  std::vector<Sample> samples = {};
  std::vector<Profile> profiles = {};
  std::vector<Field> fields = {};
  std::vector<Snapshot> snapshots = {};
  std::optional<Checkpoint> checkpoint = {};  // replaces the job's older one
  std::optional<Invariants> invariants = {};  // the same
  std::optional<int> physics_version = {};    // of the engine that computed all this
  Progress progress = {};
};

struct RunningJob {
  Lease lease;
  Owner owner;
  Job job;
  double tau_max = 0;
  Progress progress;
  std::string renewed;  // last sign of life, UTC, ISO 8601
};

}  // namespace haff::schema
