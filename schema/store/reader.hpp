// SPDX-License-Identifier: GPL-3.0-or-later

// A store as it is read: jobs, what they have measured, and whether it is as it was written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "schema/database/query.hpp"
#include "schema/digests/part.hpp"
#include "schema/error.hpp"
#include "schema/grid/job.hpp"
#include "schema/grid/target.hpp"
#include "schema/rows/measured.hpp"
#include "schema/store/faults.hpp"
#include "schema/store/shards.hpp"
#include "schema/store/work.hpp"

namespace haff::schema {

class Database;

struct CheckpointInfo {
  std::int64_t job_id = 0;
  double tau = 0;
  std::int64_t collisions = 0;
  std::int64_t bytes = 0;
};

// A row of jobs.
struct JobRow {
  std::int64_t job_id = 0;
  Job job;
  double tau_max = 0;
  double checkpoint_every = 0;
  std::optional<std::int64_t> equilibration_id;
  Status status = Status::pending;
  int attempts = 0;
  std::optional<std::string> error;
  Progress progress;
  std::optional<double> expected_cpu_seconds;
  std::string created;
  std::optional<std::string> started, finished, code_version, host;
  std::string series;        // series_identity(job): its realizations have the same
  bool starts_over = false;  // its state is damaged, and is not used
};

struct Summary {
  std::map<Status, std::int64_t> jobs;  // every status is there, also with 0
  std::int64_t claimable = 0;           // pending, could be claimed now
  std::int64_t waiting = 0;             // pending, its equilibration is pending or running
  std::int64_t elsewhere = 0;           // pending, its equilibration is lent to a shard
  std::int64_t blocked = 0;             // pending, its equilibration failed: retry that first
  double cpu_seconds = 0;               // spent, all jobs
  double expected_cpu_seconds = 0;      // for all jobs from start to tau_max, where known
  double reached_cpu_seconds = 0;       // of which stored, in proportion to tau
  double remaining_cpu_seconds = 0;     // of which still to come: of pending and running jobs
};

// The version of the stores that this program makes.
int newest_version();

// Reads a store, and cannot write it: SQLite refuses. A store of an older version is read as if it
// had been brought forward, and stays as it is.
class Reader {
 public:
  // Throws StoreError if there is no store at path, or one of a newer version.
  explicit Reader(const std::filesystem::path& path);
  ~Reader();
  Reader(Reader&&) noexcept;
  Reader& operator=(Reader&&) noexcept;

  const std::filesystem::path& path() const;

  Summary summary() const;
  std::map<Status, std::int64_t> job_counts() const;  // Summary::jobs alone, from an index
  std::vector<JobRow> jobs() const;  // by kind, d, n, particles, e, ..., seed: a table's order
  std::vector<std::int64_t> job_ids() const;
  JobRow job(std::int64_t job_id) const;
  std::optional<std::int64_t> find(const Job& job) const;
  std::vector<RunningJob> running() const;

  // Whether there is a job to claim, of which something can be stored if `fit` says so.
  bool has_claimable(const std::optional<Fit>& fit) const;
  // The least time that a job which can be claimed is expected to need to get so much further, or
  // to its end; nothing if there is none. [s of CPU time]
  std::optional<double> least_seconds_to(double tau) const;

  // Changes whenever another connection has changed the store.
  std::int64_t change_counter() const;

  // ---- what jobs have measured ----
  //
  // Each throws Damage, naming the job, if the rows are not as they were written: they are neither
  // averaged nor gone on from.

  std::vector<Sample> samples(std::int64_t job_id) const;  // by tau
  // The job's last sample with sample.tau <= tau: what a resumed job goes on from.
  std::optional<Sample> last_sample(std::int64_t job_id, double tau) const;
  // A job's profiles of this name, by tau. Averages over realizations: the view mean_profiles.
  std::vector<Profile> profiles(std::int64_t job_id, const std::string& name) const;
  std::optional<Field> field(std::int64_t job_id, const std::string& name, double tau) const;
  std::vector<FieldName> fields(std::int64_t job_id) const;        // those the job has
  std::vector<SnapshotInfo> snapshots(std::int64_t job_id) const;  // those the job has, by time
  // The snapshot at exactly this time. Throws Damage as checkpoint() does.
  std::optional<Snapshot> snapshot(std::int64_t job_id, double time) const;
  std::optional<Results> results(std::int64_t job_id) const;
  std::optional<Invariants> invariants(std::int64_t job_id) const;

  // ---- digests ----

  DigestsOfJob digests(std::int64_t job_id) const;
  // Tables that are digested as a whole and are not as they were written.
  std::vector<std::string> wrong_tables() const;
  // For programs that read the views that average: throws Damage, naming the jobs, unless these
  // parts of all finished cooling jobs are as they were written.
  void must_match_digests(const std::vector<Part>& parts) const;
  // The samples as they are, whatever their digest says: to find out what is wrong with them.
  std::vector<Sample> samples_unchecked(std::int64_t job_id) const;
  // Where this store's rows of a job differ from those of another.
  std::vector<Difference> differences(std::int64_t job_id, Part part, const Reader& other,
                                      std::int64_t job_there) const;

  std::vector<Target> targets() const;  // by series, quantity, window

  double stored_tau(std::int64_t job_id) const;     // of its newest checkpoint, or 0
  std::vector<CheckpointInfo> checkpoints() const;  // one a job at most, by job_id
  // The job's newest checkpoint. Throws Damage if a chunk is missing or a bit is wrong.
  std::optional<Checkpoint> checkpoint(std::int64_t job_id) const;

  // The campaign that this store belongs to, 32 hexadecimal digits; the name of the shard that this
  // store is, nothing in the store that lends; the shards it has lent jobs to, by name.
  std::string campaign_id() const;
  std::optional<std::string> shard_name() const;
  std::vector<Shard> shards() const;

  // What adding these jobs would do, in the order given. Changes nothing.
  std::vector<Outcome> preview(const std::vector<Planned>& plan) const;

  // One SQL statement that reads. On a Store too, SQLite is told to refuse writes meanwhile.
  Query query(const std::string& sql) const;

  // Copies the store, as it is at one moment, to a file that is not there yet, even while others
  // use it. The copy is checked; jobs that are being run are pending in it. Returns its size.
  std::uintmax_t back_up(const std::filesystem::path& to) const;

  // The store's newest rows may be missing: it was left, or copied, without the log beside it.
  bool lacks_log() const;

  // What is wrong with the file itself, and with its indexes.
  Faults faults() const;

 protected:
  friend class Store;  // reads from another store when it takes over a job
  explicit Reader(std::unique_ptr<Database> database);
  Database& database() const { return *database_; }

 private:
  void must_match(std::int64_t job_id, Part part) const;
  std::unique_ptr<Database> database_;
};

}  // namespace haff::schema
