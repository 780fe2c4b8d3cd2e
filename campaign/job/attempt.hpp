// SPDX-License-Identifier: GPL-3.0-or-later

// One attempt at a job: a claim on it, a gas, the samples not yet committed.
//
// cooling.cpp and equilibration.cpp say what happens in which order; here is how it happens. The
// gas collides in short stretches. Between them the attempt reports to the coordinator, renews its
// lease, and looks whether it is asked to stop.
#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "campaign/job/diffusion.hpp"
#include "campaign/job/report.hpp"
#include "campaign/job/views.hpp"
#include "engine/simulation.hpp"
#include "schema/store/store.hpp"

namespace haff::campaign {

// How an attempt can end, other than by an exception. `left`: asked to stop, given back.
enum class Ending { finished, collapsed, left };

class Attempt {
 public:
  // `threads`: how many the job should have now. It is asked at the beginning and at every commit,
  // since other jobs end meanwhile.
  Attempt(
      schema::Store& store, const schema::Claim& claim, const Reporter& reporter,
      std::function<unsigned()> threads = [] { return 1U; });

  const schema::Job& job() const { return claim_.job; }
  const schema::Claim& claim() const { return claim_; }
  const std::vector<schema::Sample>& samples() const { return samples_; }

  // The stored state of this job or of another, if there is one. Throws DamagedCheckpoint.
  std::optional<engine::State> stored_state() const;
  engine::State state_of_equilibration() const;

  // Start from this state, with the samples the store has up to it.
  void begin(const engine::State& state);

  // False if asked to stop, unless the state can be stored soon, at the next synchronization, or a
  // limit asks (SIGUSR1), which leaves the time for that.
  // Takes the samples and snapshots at moments in time that come on the way.
  [[nodiscard]] bool advance_to(std::int64_t collisions);

  void sample(double tau);    // and the profiles and fields that go with it
  void snapshot(double tau);  // the whole gas
  void commit(double tau);    // what was measured and the state, at a synchronization
  bool is_asked_to_leave() const;

  Ending leave();
  // The end of the job: commits what is left, with the state if the job ends at a synchronization.
  Ending finish(std::optional<double> synchronization_tau,
                const std::optional<schema::Results>& results);

  // The end of the job in inelastic collapse: its series up to here is kept.
  Ending collapse(const std::string& what);

  // Where it is, for messages: "seed 3, tau 12.5, 100000 collisions".
  std::string place() const;

 private:
  using Clock = std::chrono::steady_clock;

  // Samples and snapshots at moments of time: the next, infinity if there is none.
  double next_time() const { return std::min(sample_time_, snapshot_time_); }
  void see_to_time(double time);
  void add_snapshot(double tau, double time);
  // Commits what was measured, without a state: it comes out again after an interruption.
  void commit_rows();
  void forget_pending();  // it is in the store

  void log(const std::string& what) const;
  void make_gas(const engine::State& state);
  void adapt_threads();
  void report_progress();
  // Whether an attempt that is asked to stop collides on to the next synchronization first.
  bool may_go_on_to_synchronization() const;
  double seconds_to_synchronization() const;  // expected; infinite before the first collision
  double collisions_per_second() const;
  double tau() const;
  schema::Progress progress(double tau) const;
  // What the store does not have yet, except the state.
  schema::Commit pending_commit(double tau) const;
  schema::Checkpoint checkpoint(double tau) const;

  schema::Store& store_;
  const schema::Claim& claim_;
  const Reporter& reporter_;
  std::function<unsigned()> threads_wanted_;
  unsigned threads_ = 1;
  std::optional<engine::Simulation> gas_;
  std::vector<schema::Sample> samples_;
  std::size_t committed_ = 0;                // of samples_, or in the store from an earlier attempt
  Views views_;                              // since the last commit
  std::vector<schema::Snapshot> snapshots_;  // the same
  double sample_time_ = 0, snapshot_time_ = 0;  // the next of each
  Diffusion diffusion_;

  double cpu_at_start_;
  Clock::time_point reported_, renewed_, speed_since_;
  std::int64_t speed_from_ = 0;
};

}  // namespace haff::campaign
