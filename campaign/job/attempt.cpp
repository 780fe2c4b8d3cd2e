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
#include "campaign/job/collisions.hpp"
#include "campaign/job/measurement.hpp"
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

}  // namespace

Attempt::Attempt(schema::Store& store, const schema::Claim& claim, const Reporter& reporter,
                 unsigned threads)
    : store_(store),
      claim_(claim),
      reporter_(reporter),
      threads_(threads),
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
  // What was sampled after this state will come out again, and is compared then.
  std::erase_if(samples_, [&](const schema::Sample& sample) {
    return engine::collisions_at(sample.tau, job().particles) > state.collisions;
  });
  committed_ = samples_.size();
  views_ = {};
  const engine::Model model = model_of(job());
  gas_.emplace(model, state, engine::SearchBackend::simd, engine::Threads{.count = threads_});
  if (threads_ > 1 && model.counts_collisions)
    log("runs on one thread: collision_statistics needs the order of all collisions");
  diffusion_.begin(*gas_, state);
  if (gas_->collisions() > 0) log(fmt::format("goes on from tau = {:.6g}", tau()));
  speed_from_ = gas_->collisions();
  speed_since_ = renewed_ = Clock::now();
  report_progress();
}

bool Attempt::advance_to(std::int64_t collisions) {
  while (gas_->collisions() < collisions) {
    gas_->run_to(std::min({collisions, gas_->collisions() + stretch, diffusion_.next_look()}));
    if (gas_->collisions() == diffusion_.next_look()) diffusion_.look(*gas_);
    report_progress();
    if (gas_->collisions() < collisions && is_asked_to_leave() && !may_go_on_to_synchronization())
      return false;  // there, what is due is done first: a state may be stored
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

void Attempt::commit(double tau) {
  schema::Commit commit = pending_commit(tau);
  commit.checkpoint = checkpoint(tau);
  store_.commit(claim_.lease, commit);
  committed_ = samples_.size();
  views_ = {};
}

bool Attempt::is_asked_to_leave() const {
  return stop_signal() != 0;
}

// At a limit (SIGUSR1) nothing that was computed is given up.
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
