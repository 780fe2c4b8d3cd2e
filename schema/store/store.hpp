// The store: one SQLite file with everything a campaign knows (tables: 001-store.sql).
//
//   Store store = Store::create("campaign.db");
//   store.add(plan);
//   while (auto claim = store.claim(owner, code_version)) {
//     ...
//     store.commit(claim->lease, {.samples = samples, .checkpoint = checkpoint, .progress = ...});
//     ...
//     store.finish(claim->lease, last_commit, results, claim->tau_max);
//   }
//
// What is promised (schema/README.md says by which means). Every function that writes is
// one transaction: it happens entirely or not at all, whenever the process is killed. Many
// processes on one machine may read and write at the same time; between open_log() and close_log()
// readers never wait, and writers wait for each other up to busy_timeout. At power loss the newest
// transactions may be undone, in order, and the store stays sound: since samples and the checkpoint
// that follows them are one transaction, what is undone is computed again, with the same bits. A
// full disk undoes the transaction and is reported.
//
// One connection belongs to one thread, and must not be used across fork().
// All functions throw the types of error.hpp.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "schema/database/query.hpp"
#include "schema/error.hpp"
#include "schema/file/log.hpp"
#include "schema/grid/job.hpp"
#include "schema/grid/target.hpp"
#include "schema/store/shards.hpp"

namespace haff::schema {

// Errors in a row, with no new checkpoint between them, after which a job is failed for good.
inline constexpr int max_attempts = 3;

// How long a writer waits for others before it gives up. A commit of a large checkpoint to a slow
// disk takes seconds; several workers may queue.
inline constexpr std::chrono::milliseconds busy_timeout{120'000};

// Checkpoints are cut into BLOBs of this size. SQLite holds one whole in memory, and refuses any
// above 1 GB. [bytes]
inline constexpr std::size_t chunk_bytes = std::size_t{16} << 20;

// ---- rows -------------------------------------------------------------------------------------

// One row of samples; a value that does not exist (first sample, observable not asked for) is
// empty, and NULL in the store. A value that is not finite is refused.
struct Sample {
  double tau = 0;                             // k sample_every [collisions per particle]
  double time = 0;                            // true time [sigma sqrt(m/E(0))]
  std::optional<double> temperature = {};     // T = (m/d) <v^2> [E(0)]
  std::optional<double> gamma_ratio = {};     // gamma/gamma_0, middle of the interval before tau
  std::optional<double> collision_rate = {};  // omega [per particle and time], same interval
  std::optional<double> pressure = {};        // [E(0) sigma^-d], same interval
  std::optional<double> a2 = {}, a3 = {}, a4 = {}, a5 = {}, a6 = {};  // Laguerre coefficients
  std::optional<double> correlation_trace = {};  // Tr G^+(0) [E(0)/m], where profiles are taken
  std::optional<double> largest_cluster = {};    // part of the particles, where profiles are taken
  std::optional<double> rotational_temperature =
      {};  // (I/3) <omega^2>, of disks I <omega^2> [E(0)], roughness
  std::optional<double> temperature_1 = {}, temperature_2 = {};  // of each species [E(0)], mixture

  bool operator==(const Sample&) const = default;
};

// A curve at the tau of a sample. Names, x and units: 002-profiles.sql. Values are finite.
struct Profile {
  std::string name;
  double tau = 0;
  std::vector<double> x = {}, value = {};  // x increases

  bool operator==(const Profile&) const = default;
};

// The gas in cells^d cells at the tau of a sample. Names, order of values and units:
// 002-profiles.sql.
struct Field {
  std::string name;
  double tau = 0;
  int cells = 0;  // along each axis
  int components = 1;
  double box = 0;                   // side [sigma]
  std::vector<double> values = {};  // NaN where a cell has none
};

struct FieldName {
  std::string name;
  double tau = 0;
};

struct Results {
  std::optional<double> tau_c = {};   // first tau with T_Haff(tau) = T(tau)/2
  std::optional<double> time_c = {};  // the time of tau_c [sigma sqrt(m/E(0))]

  bool operator==(const Results&) const = default;
};

// A row of invariants: whether the physics of a run held, counted since its start.
struct Invariants {
  double largest_overlap = 0;  // [sigma]
  std::int64_t past_events = 0;
  std::int64_t unresolved_collisions = 0;
  double energy_mismatch = 0;   // relative
  double momentum_removed = 0;  // relative to sqrt(N) rms speeds

  bool operator==(const Invariants&) const = default;
};

// A state of the engine, encoded by the campaign.
struct Checkpoint {
  double tau = 0;
  std::int64_t collisions = 0;
  std::vector<std::byte> state = {};
};

// How far a job is.
struct Progress {
  double tau = 0;
  std::int64_t collisions = 0;
  double cpu_seconds = 0;  // over all attempts: what the claim said, plus the worker's own
};

// ---- digests ----------------------------------------------------------------------------------

// What a job has in the store, by the table that holds it. Each has a digest (017-digests.sql).
enum class Part { jobs, samples, profiles, fields, results, invariants, checkpoints, loans };
inline constexpr std::size_t part_count = 8;
const char* name(Part part);  // of the table

// What the digests say of a job.
struct DigestsOfJob {
  std::vector<Part> wrong = {};    // these rows are not as they were written
  std::vector<Part> without = {};  // these have none: a program of an older version wrote them
};

// Where the rows of two stores differ.
struct Difference {
  Part part = Part::samples;
  std::string row;          // "tau = 3", "name = S, tau = 10, x = 0.5"; of a job's only row: empty
  std::string column = {};  // none: one of the two lacks the row
  std::string here, there;  // both values, with all digits
  // Of a logarithm or a transform, which differ that little between two libraries.
  bool is_in_last_digits = false;
};

// ---- planning ---------------------------------------------------------------------------------

struct Planned {
  Job job;
  double tau_max = 0;
  double checkpoint_every = 10;
  std::optional<double> expected_cpu_seconds = {};  // to reach tau_max from the start
};

// What became, or would become, of one planned job. extended: it was there with a smaller
// tau_max, which is now the larger one; done jobs are pending again. A collapsed job stays as it
// is.
enum class Outcome { added, extended, unchanged };

// ---- working ----------------------------------------------------------------------------------

// A process, told apart from every other that ever had its number.
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

// Whether something of a job can be stored in the time that is left: whether it is expected to get
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

// What a worker has to say at once, written in one transaction: what was measured before the
// checkpoint and the checkpoint, so that the store never knows one without the other.
struct Commit {
  std::vector<Sample> samples = {};
  std::vector<Profile> profiles = {};
  std::vector<Field> fields = {};
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

// ---- reading ----------------------------------------------------------------------------------

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
  // Each throws Damage, naming the job, if the rows are not as they were written: whatever averages
  // or goes on from them, refuses them.

  std::vector<Sample> samples(std::int64_t job_id) const;  // by tau
  // The job's last sample with sample.tau <= tau: what a resumed job goes on from.
  std::optional<Sample> last_sample(std::int64_t job_id, double tau) const;
  // A job's profiles of this name, by tau. Averages over realizations: the view mean_profiles.
  std::vector<Profile> profiles(std::int64_t job_id, const std::string& name) const;
  std::optional<Field> field(std::int64_t job_id, const std::string& name, double tau) const;
  std::vector<FieldName> fields(std::int64_t job_id) const;  // those the job has
  std::optional<Results> results(std::int64_t job_id) const;
  std::optional<Invariants> invariants(std::int64_t job_id) const;

  // ---- digests ----

  DigestsOfJob digests(std::int64_t job_id) const;
  // Tables that are digested as a whole and are not as they were written.
  std::vector<std::string> wrong_tables() const;
  // For whoever reads the views that average: throws Damage, naming the jobs, unless these parts of
  // all finished cooling jobs are as they were written.
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

  // Copies the store to a file that is not there yet, as it is at one moment, whatever else uses
  // it. What is copied is checked; jobs that are being run are pending in the copy. Returns its
  // size.
  std::uintmax_t back_up(const std::filesystem::path& to) const;

  // The store's newest rows may be missing: it was left, or copied, without the log beside it.
  bool lacks_log() const;

  // SQLite's integrity check and the foreign keys: one line a fault, none if all is sound.
  std::vector<std::string> faults() const;

 protected:
  friend class Store;  // which reads from another store when it takes over a job
  explicit Reader(std::unique_ptr<Database> database);
  Database& database() const { return *database_; }

 private:
  void must_match(std::int64_t job_id, Part part) const;
  std::unique_ptr<Database> database_;
};

// Reads and writes a store.
class Store : public Reader {
 public:
  // The store at path, made if there is none. Throws StoreError if it is of an older version.
  static Store create(const std::filesystem::path& path);
  // The same, but there must be one.
  static Store open(const std::filesystem::path& path);
  // One without a file, gone when it is closed.
  static Store in_memory();

  // Brings a store of an older version forward, and gives back the jobs that were held under these
  // leases, whose owners are dead. Throws StoreError, and changes nothing, if another job is being
  // run: its worker is a program of the old version. Returns the version that it was of.
  static int upgrade(const std::filesystem::path& path, const std::vector<Lease>& dead);

  // From here on many processes may write while others read. Who opened the log calls copy_log()
  // now and then, or it grows; close_log() makes one plain file of the store again, and returns
  // false if somebody else still uses it.
  void open_log();
  LogSize copy_log();
  bool close_log(std::chrono::milliseconds patience);

  // What has happened to the file at the store's path, if it is no longer the one that is open:
  // "was deleted or moved away". Whatever is written from then on is lost when the store is closed.
  std::optional<std::string> displaced() const;
  // The log of a store that is displaced must not stay beside another file: deletes it, or keeps it
  // under another name.
  void abandon_log(const std::filesystem::path& kept_as = {});

  // Add the jobs that are missing, extend those that are there with a smaller tau_max: one
  // transaction, outcomes in the order given. A cooling job's equilibration must be in the plan
  // (anywhere) or in the store: std::logic_error otherwise. A plan names a job once.
  std::vector<Outcome> add(const std::vector<Planned>& plan);

  // Add targets. Of one that is there only the standard error changes: its pilot runs stay, so that
  // what is already known of the results does not choose them.
  void add(const std::vector<Target>& targets);

  // Keep what a target of the store is expected to take. What was expected first stays.
  void predict(const Target& target, const Prediction& prediction);

  // Wait for locks of other processes only while this function, asked some times a second, says
  // so, and never longer than busy_timeout. What waits longer throws Locked.
  void wait_for_locks_while(bool (*may_wait)());

  // Take a job that can be run: equilibrations first, then those whose remaining time is longest,
  // so that the last ones to finish are short. Nothing if none can be run now (see Summary), or
  // none of which something can be stored, where `fit` says how much time there is.
  std::optional<Claim> claim(const Owner& owner, const std::string& code_version,
                             const std::optional<Fit>& fit = {});

  // Still alive, and so far. Throws LeaseLost like everything below.
  void progress(const Lease& lease, const Progress& progress);

  // Samples, profiles and fields that are there already are kept as they are; if the time or
  // temperature of a sample came out different, Damage. A checkpoint sets the job's attempts back
  // to 0.
  void commit(const Lease& lease, const Commit& commit);

  // The last commit of a job, its results (cooling only), and its end. tau_max: what the worker
  // ran to. Returns done, or pending if a plan extended the job meanwhile.
  Status finish(const Lease& lease, const Commit& commit, const std::optional<Results>& results,
                double tau_max);

  // The end of a job in inelastic collapse: its samples up to then are kept, `what` as its error.
  void collapse(const Lease& lease, const Commit& commit, const std::string& what);

  // An error ended this attempt: pending again, or failed if it was the last. Returns which.
  // `again`: whether another attempt may succeed; if not, the job fails at once.
  Status fail(const Lease& lease, const std::string& error, bool again = true);

  // Give the job back unfinished, at its last checkpoint; costs no attempt.
  void release(const Lease& lease);

  // The same for a job whose owner is dead. False if it was no longer held under this lease.
  bool reclaim(const Lease& lease);

  // failed -> pending with all attempts. Returns how many.
  std::int64_t retry_failed();

  // For a job whose checkpoint is damaged: makes the job pending with all attempts, to begin at its
  // start. The old checkpoint stays, unused, until a new one takes its place; samples and results
  // stay and are compared when they come out again. False, and nothing done, if a worker or a
  // shard holds the job.
  bool restart(std::int64_t job_id);

  // Where rows of this part differ from those of the other store, puts the other's in their place;
  // the part is digested as it is then. Returns how many rows differed.
  std::int64_t replace_rows(std::int64_t job_id, Part part, const Reader& other,
                            std::int64_t job_there);
  // This part of a job was found to be right by other means: it is digested as it is.
  void digest_again(std::int64_t job_id, Part part);
  void digest_table_again(const std::string& table);
  // A job's row of the table jobs is not as it was written. If one bit turned back makes it so,
  // turns it back, and says which value was changed, from what, to what. Nothing, and nothing done,
  // if no single bit does.
  std::optional<Difference> turn_bit_back(std::int64_t job_id);
  // For a job whose rows contradict themselves, and that nobody holds: drops the rows after tau,
  // with the results. What is left is digested as it is. Returns how many samples were dropped.
  std::int64_t drop_rows_after(std::int64_t job_id, double tau);

  // Lend pending jobs to new shards: one transaction. Throws StoreError if a job is no longer
  // pending (a run has taken it), or a shard of that name is there.
  void lend(const std::vector<Loan>& loans);

  // Make a new, empty store a shard of a campaign.
  void become_shard(const std::string& campaign_id, const std::string& name);

  // Take over what another store knows of one of its jobs: rows that are missing here, and its
  // state, results and cost if it is ahead. A job that is not here is added. One transaction.
  // `shard` names the shard that is merged; empty when a shard is being made. Throws Damage, and
  // changes nothing, if a row that both have differs: the message names job, tau, column and both
  // values.
  Arrival take_over(const Reader& other, std::int64_t job_id, const std::string& shard = {});

  // Note that a shard was merged, and that it is back if it has ended all its jobs.
  void note_merge(const std::string& shard);

  // Take back what a shard has not finished: those jobs are pending again, unless another shard
  // holds them too. Returns how many.
  std::int64_t recall(const std::string& shard);

 private:
  using Reader::Reader;
};

}  // namespace haff::schema
