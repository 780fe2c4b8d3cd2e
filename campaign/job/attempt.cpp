// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/job/attempt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <stdexcept>
#include <utility>

#include "campaign/base/process/cpu_time.hpp"
#include "campaign/base/process/signals.hpp"
#include "campaign/base/text/job_text.hpp"
#include "campaign/job/at_time.hpp"
#include "campaign/job/collisions.hpp"
#include "campaign/job/measurement.hpp"
#include "campaign/job/timetable.hpp"
#include "campaign/state/checkpoint.hpp"
#include "campaign/state/model.hpp"
#include "campaign/state/restore.hpp"
#include "engine/soundness.hpp"

namespace haff::campaign {
namespace {

using namespace std::chrono_literals;

// Some 10 ms of a gas in cache, 100 ms of a large and clustered one. [pair collisions]
constexpr std::int64_t stretch = 20'000;

constexpr auto report_every = 200ms;  // progress bars
constexpr auto renew_every = 5s;      // the lease, and tau as `campaign status` shows it

// A worker that is asked to stop goes on to the next synchronization, where its gas can be stored,
// if that is expected to take no longer than this: the coordinator kills it five seconds after the
// signal. [s]
constexpr double patience = 3.0;

std::string threads_text(unsigned threads) {
  return threads == 1 ? "1 thread" : fmt::format("{} threads", threads);
}

}  // namespace

Attempt::Attempt(schema::Store& store, const schema::Claim& claim, const Reporter& reporter,
                 std::function<unsigned()> threads)
    : store_(store),
      claim_(claim),
      reporter_(reporter),
      threads_wanted_(std::move(threads)),
      diffusion_(claim.job),
      cpu_at_start_(cpu_seconds()) {}

std::optional<engine::State> Attempt::stored_state() const {
  if (claim_.starts_over) return std::nullopt;
  return state_to_go_on_from(store_, claim_.lease.job_id, job());
}

engine::State Attempt::state_of_equilibration() const {
  const std::int64_t id = claim_.equilibration_id.value();
  auto state = state_to_go_on_from(store_, id, store_.job(id).job);
  if (!state)
    throw std::runtime_error(
        fmt::format("the equilibration it starts from, job {}, is done but "
                    "its state is gone; `campaign retry` computes it again",
                    id));
  return *std::move(state);
}

void Attempt::begin(const engine::State& state) {
  samples_.clear();
  if (state.collisions > 0) samples_ = store_.samples(claim_.lease.job_id);
  // Samples after this state come out again, and are compared then.
  std::erase_if(samples_, [&](const schema::Sample& sample) {
    return engine::collisions_at(sample.tau, job().particles) > state.collisions;
  });
  committed_ = samples_.size();
  views_ = {};
  threads_ = threads_wanted_();
  if (threads_ > 1 && model_of(job()).counts_collisions)
    log("runs on one thread: collision_statistics needs the order of all collisions");
  make_gas(state);
  snapshots_.clear();
  const auto first = [&](const schema::Moments& moments) {
    return moments.next(std::nextafter(gas_->time(), -1.0));
  };
  sample_time_ = first(job().sample_at.time);
  snapshot_time_ = first(job().snapshots_at.time);
  if (gas_->collisions() > 0) log(fmt::format("goes on from tau = {:.6g}", tau()));
  speed_from_ = gas_->collisions();
  speed_since_ = renewed_ = Clock::now();
  report_progress();
}

void Attempt::make_gas(const engine::State& state) {
  gas_.emplace(model_of(job()), state, engine::SearchBackend::simd,
               engine::Threads{.count = threads_});
  diffusion_.begin(*gas_, state);
}

// With another number of threads, the gas goes on from its state as if that had been stored.
void Attempt::adapt_threads() {
  const unsigned wanted = threads_wanted_();
  if (wanted == threads_ || model_of(job()).counts_collisions) return;
  log(fmt::format("goes on with {}, {} before", threads_text(wanted), threads_));
  threads_ = wanted;
  engine::State state = gas_->state();
  diffusion_.store(state);
  gas_.reset();
  make_gas(state);
  speed_from_ = gas_->collisions();
  speed_since_ = Clock::now();
}

bool Attempt::advance_to(std::int64_t collisions) {
  while (gas_->collisions() < collisions) {
    const std::int64_t stop =
        std::min({collisions, gas_->collisions() + stretch, diffusion_.next_look()});
    if (gas_->run_to(stop, next_time())) {
      see_to_time(next_time());
      continue;
    }
    if (gas_->collisions() == diffusion_.next_look()) diffusion_.look(*gas_);
    report_progress();
    if (gas_->collisions() < collisions && is_asked_to_leave() && !may_go_on_to_synchronization())
      return false;  // what is due there is done first: a state may be stored
  }
  return true;
}

void Attempt::sample(double tau) {
  schema::Sample sample = measure(*gas_, job(), tau, samples_);
  const Views taken = view(*gas_, job(), sample);
  const auto diffused = diffusion_.sample(*gas_, tau);
  const auto collided = collision_statistics(*gas_, job(), tau);
  samples_.push_back(sample);
  views_.profiles.insert(views_.profiles.end(), taken.profiles.begin(), taken.profiles.end());
  views_.profiles.insert(views_.profiles.end(), diffused.begin(), diffused.end());
  views_.profiles.insert(views_.profiles.end(), collided.begin(), collided.end());
  views_.fields.insert(views_.fields.end(), taken.fields.begin(), taken.fields.end());
}

void Attempt::snapshot(double tau) {
  add_snapshot(tau, gas_->time());
}

void Attempt::add_snapshot(double tau, double time) {
  snapshots_.push_back({.tau = tau,
                        .time = time,
                        .collisions = gas_->collisions(),
                        .state = encode(gas_->snapshot())});
  std::size_t bytes = 0;
  for (const schema::Snapshot& each : snapshots_) bytes += each.state.size();
  if (bytes > most_waiting_snapshots) commit_rows();
}

void Attempt::see_to_time(double time) {
  if (sample_time_ == time) {
    const auto points = measure_at_time(*gas_, job(), time);
    views_.profiles.insert(views_.profiles.end(), points.begin(), points.end());
    sample_time_ = job().sample_at.time.next(time);
  }
  if (snapshot_time_ == time) {
    add_snapshot(tau(), time);
    snapshot_time_ = job().snapshots_at.time.next(time);
  }
}

void Attempt::commit(double tau) {
  schema::Commit commit = pending_commit(tau);
  commit.checkpoint = checkpoint(tau);
  store_.commit(claim_.lease, commit);
  forget_pending();
  if (!is_asked_to_leave() && tau < claim_.tau_max) adapt_threads();
}

void Attempt::commit_rows() {
  store_.commit(claim_.lease, pending_commit(tau()));
  forget_pending();
}

void Attempt::forget_pending() {
  committed_ = samples_.size();
  views_ = {};
  snapshots_.clear();
}

bool Attempt::is_asked_to_leave() const {
  return stop_signal() != 0;
}

// At a limit (SIGUSR1) no computed result is given up.
bool Attempt::may_go_on_to_synchronization() const {
  return stop_signal() == SIGUSR1 || seconds_to_synchronization() < patience;
}

Ending Attempt::leave() {
  store_.release(claim_.lease);
  const double stored = store_.stored_tau(claim_.lease.job_id);
  if (gas_->collisions() > engine::collisions_at(stored, job().particles))
    log(
        fmt::format("is left at tau = {:.6g}; what was computed from there to tau = {:.6g} is not "
                    "stored: that would have taken another {:.1f} s",
                    stored, tau(), seconds_to_synchronization()));
  else
    log(fmt::format("is left at tau = {:.6g}", stored));
  return Ending::left;
}

Ending Attempt::finish(std::optional<double> synchronization_tau,
                       const std::optional<schema::Results>& results) {
  schema::Commit last = pending_commit(synchronization_tau.value_or(claim_.tau_max));
  if (synchronization_tau) last.checkpoint = checkpoint(*synchronization_tau);
  store_.finish(claim_.lease, last, results, claim_.tau_max);
  return Ending::finished;
}

Ending Attempt::collapse(const std::string& what) {
  store_.collapse(claim_.lease, pending_commit(tau()), what);
  return Ending::collapsed;
}

std::string Attempt::place() const {
  if (!gas_) return fmt::format("seed {}, before the first collision", job().seed);
  return fmt::format("seed {}, tau {:.6g}, {} collisions", job().seed, tau(), gas_->collisions());
}

void Attempt::log(const std::string& what) const {
  reporter_.send(
      LogReport{LogReport::Level::info,
                fmt::format("job {} ({}) {}", claim_.lease.job_id, describe(job()), what)});
}

void Attempt::report_progress() {
  const auto now = Clock::now();
  if (now - reported_ >= report_every) {
    reported_ = now;
    reporter_.send(ProgressReport{claim_.lease.job_id, describe(job()), tau(), claim_.tau_max,
                                  collisions_per_second()});
  }
  if (now - renewed_ >= renew_every) {
    renewed_ = now;
    store_.progress(claim_.lease, progress(tau()));
  }
}

double Attempt::seconds_to_synchronization() const {
  const double period = engine::synchronization_period;
  const double left = period - std::fmod(tau(), period);
  return left * job().particles / 2 / collisions_per_second();
}

double Attempt::collisions_per_second() const {
  const std::chrono::duration<double> elapsed = Clock::now() - speed_since_;
  const auto collisions = static_cast<double>(gas_->collisions() - speed_from_);
  return elapsed.count() > 0 ? collisions / elapsed.count() : 0;
}

double Attempt::tau() const {
  return 2 * static_cast<double>(gas_->collisions()) / job().particles;
}

schema::Progress Attempt::progress(double tau) const {
  return {.tau = tau,
          .collisions = gas_->collisions(),
          .cpu_seconds = claim_.cpu_seconds + cpu_seconds() - cpu_at_start_};
}

schema::Commit Attempt::pending_commit(double tau) const {
  const engine::Invariants seen = gas_->invariants();
  return {.samples = {samples_.begin() + static_cast<std::ptrdiff_t>(committed_), samples_.end()},
          .profiles = views_.profiles,
          .fields = views_.fields,
          .snapshots = snapshots_,
          .invariants = schema::Invariants{.largest_overlap = engine::largest_overlap(seen),
                                           .past_events = seen.past_events,
                                           .unresolved_collisions = seen.unresolved_collisions,
                                           .energy_mismatch = seen.energy_mismatch,
                                           .momentum_removed = seen.momentum_removed},
          .physics_version = engine::physics_version,
          .progress = progress(tau)};
}

schema::Checkpoint Attempt::checkpoint(double tau) const {
  engine::State state = gas_->state();
  diffusion_.store(state);
  return {.tau = tau, .collisions = gas_->collisions(), .state = encode(state)};
}

}  // namespace haff::campaign
