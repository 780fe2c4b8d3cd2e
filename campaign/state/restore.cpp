// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/state/restore.hpp"

#include <fmt/format.h>

#include <cmath>

#include "campaign/base/text/job_text.hpp"
#include "campaign/state/energy.hpp"
#include "campaign/state/model.hpp"
#include "engine/initial.hpp"
#include "engine/simulation.hpp"
#include "engine/soundness.hpp"

namespace haff::campaign {
namespace {

std::optional<std::string> contradiction(const engine::State& state, const schema::Job& job) {
  if (state.particles() != job.particles)
    return fmt::format("it holds {} particles, the job has {}", state.particles(), job.particles);
  if (state.d != job.d) return fmt::format("it is of dimension {}, the job of {}", state.d, job.d);
  const double box = engine::box_side(job.n, job.particles, job.d);
  if (state.box != box) return fmt::format("its box has side {}, the job's {}", state.box, box);
  if (mixture_in(state) != mixture_of(job)) return "it holds a gas of other species";
  if (auto wrong = unsoundness(state)) return wrong;
  return energy_contradiction(state, job, {});
}

DamagedCheckpoint not_at(const engine::State& state, double tau) {
  return DamagedCheckpoint(fmt::format(
      "it holds the state after {} collisions, which is not tau = {}", state.collisions, tau));
}

}  // namespace

engine::State restore(const schema::Checkpoint& checkpoint, const schema::Job& job) {
  engine::State state = decode(checkpoint.state);
  if (const auto wrong = contradiction(state, job)) throw DamagedCheckpoint(*wrong);
  if (state.collisions != checkpoint.collisions ||
      state.collisions != engine::collisions_at(checkpoint.tau, job.particles))
    throw not_at(state, checkpoint.tau);
  return state;
}

std::optional<engine::State> stored_state(const schema::Reader& store, std::int64_t job_id,
                                          const schema::Job& job) {
  const auto checkpoint = store.checkpoint(job_id);
  if (!checkpoint) return std::nullopt;
  engine::State state = restore(*checkpoint, job);
  // The samples are read after the checkpoint: a job that is being run may have more by now, never
  // fewer.
  if (const auto wrong = energy_contradiction(state, job, store.samples(job_id)))
    throw DamagedCheckpoint(*wrong);
  return state;
}

std::optional<engine::State> newest_state(const schema::Reader& store, std::int64_t job_id,
                                          const schema::Job& job) {
  const auto damaged = [&](const std::exception& why) {
    return DamagedCheckpoint(
        fmt::format("the checkpoint of job {} ({}) is damaged and was not used: {}; "
                    "`campaign retry` computes that job again from its start",
                    job_id, describe(job), why.what()));
  };
  try {
    return stored_state(store, job_id, job);
  } catch (const schema::DamagedFile&) {
    throw;
  } catch (const schema::Damage& damage) {
    throw damaged(damage);
  } catch (const DamagedCheckpoint& damage) {
    throw damaged(damage);
  } catch (const NewerCheckpoint& newer) {
    throw NewerCheckpoint(
        fmt::format("the state of job {} ({}) was written by a newer program: {}; update campaign",
                    job_id, describe(job), newer.what()));
  }
}

std::optional<engine::State> snapshot_state(const schema::Reader& store, std::int64_t job_id,
                                            const schema::Job& job, double time) {
  const auto snapshot = store.snapshot(job_id, time);
  if (!snapshot) return std::nullopt;
  const std::string name =
      fmt::format("the snapshot of job {} ({}) at tau = {}", job_id, describe(job), snapshot->tau);
  try {
    engine::State state = decode(snapshot->state);
    if (const auto wrong = contradiction(state, job)) throw DamagedCheckpoint(*wrong);
    // The tau of a moment in time is rounded.
    const double collisions = 0.5 * snapshot->tau * job.particles;
    if (state.collisions != snapshot->collisions ||
        std::abs(static_cast<double>(state.collisions) - collisions) > 1)
      throw not_at(state, snapshot->tau);
    return state;
  } catch (const DamagedCheckpoint& damage) {
    throw DamagedCheckpoint(fmt::format("{} is damaged: {}", name, damage.what()));
  } catch (const NewerCheckpoint& newer) {
    throw NewerCheckpoint(
        fmt::format("{} was written by a newer program: {}; update campaign", name, newer.what()));
  }
}

std::optional<std::string> foreign_physics(const schema::Checkpoint& checkpoint) {
  const int found = physics_version_of(checkpoint.state);
  if (found == engine::physics_version) return std::nullopt;
  return fmt::format(
      "it was computed with physics version {}, and this program computes version {}", found,
      engine::physics_version);
}

std::optional<engine::State> state_to_go_on_from(const schema::Reader& store, std::int64_t job_id,
                                                 const schema::Job& job) {
  auto state = newest_state(store, job_id, job);
  if (state)
    if (const auto why = foreign_physics(store.checkpoint(job_id).value()))
      throw DamagedCheckpoint(
          fmt::format("the checkpoint of job {} ({}) was not used: {}; go on with the program that "
                      "began it, or let `campaign retry` compute that job again from its start",
                      job_id, describe(job), *why));
  return state;
}

}  // namespace haff::campaign
