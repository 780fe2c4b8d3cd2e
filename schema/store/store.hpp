// SPDX-License-Identifier: GPL-3.0-or-later

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
// What is promised (schema/README.md says by which means): every function that writes is
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
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "schema/error.hpp"
#include "schema/file/log.hpp"
#include "schema/store/reader.hpp"

namespace haff::schema {

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

  // From here on many processes may write while others read. The process that opened the log calls
  // copy_log() now and then, or it grows; close_log() makes one plain file of the store again, and
  // returns false if another process still uses it.
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

  // Add targets. A target that is there changes its standard error only. Its pilot runs stay, so
  // that they are not chosen by results that are already known.
  void add(const std::vector<Target>& targets);

  // Keep what a target of the store is expected to take. What was expected first stays.
  void predict(const Target& target, const CostPrediction& prediction);

  // Wait for locks of other processes only while this function, asked some times a second, says
  // so, and never longer than busy_timeout. What waits longer throws Locked.
  void wait_for_locks_while(bool (*may_wait)());

  // Take a job that can be run: equilibrations first, then those whose remaining time is longest,
  // so that the last ones to finish are short. Nothing if none can be run now (see Summary), or
  // none of which something can be stored, where `fit` says how much time there is.
  std::optional<Claim> claim(const Owner& owner, const std::string& code_version,
                             const std::optional<Fit>& fit = {});

  // Says that the worker is alive, and how far it is. Throws LeaseLost, as all below do.
  void progress(const Lease& lease, const Progress& progress);

  // Samples, profiles and fields that are there already are kept as they are; if a column of a
  // sample, in which two computations must agree, came out different, Damage. A checkpoint sets the
  // job's attempts back to 0.
  void commit(const Lease& lease, const Commit& commit);

  // The last commit of a job that ran to tau_max, its results (cooling only), and its end: done, or
  // pending if a plan extended it. Damage, if a finished job of the same physics has other samples.
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

  // For a store with Faults::derived alone.
  void make_derived_anew();
  // Where rows of this part differ from those of the other store, puts the other's in their place;
  // the part is digested as it is then. Rows that differ in last digits alone stay, unless the
  // digest says that they were altered. Returns how many rows were replaced.
  std::int64_t replace_rows(std::int64_t job_id, Part part, const Reader& other,
                            std::int64_t job_there);
  // This part of a job was found to be right by other means: it is digested as it is.
  void digest_again(std::int64_t job_id, Part part);
  void digest_table_again(const std::string& table);
  // A job's row of the table jobs is not as it was written. If one bit turned back makes it so,
  // turns it back, and says which value was changed, from what, to what. Nothing, and nothing done,
  // if no single bit does.
  std::optional<Difference> turn_bit_back(std::int64_t job_id);
  // For a job whose rows contradict each other, and that no worker holds: drops the rows after tau,
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
