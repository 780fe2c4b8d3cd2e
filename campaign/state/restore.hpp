// SPDX-License-Identifier: GPL-3.0-or-later

// From a checkpoint in the store to a state from which the engine may go on.
#pragma once

#include <optional>
#include <string>

#include "campaign/state/checkpoint.hpp"
#include "schema/store/store.hpp"

namespace haff::campaign {

// The state of the job. Throws DamagedCheckpoint if it does not decode, is not a state of this
// job, or cannot be one of hard spheres with no more energy than was put in: such a state is never
// used. Throws NewerCheckpoint if a newer program wrote it.
engine::State restore(const schema::Checkpoint& checkpoint, const schema::Job& job);

// The newest state of a job in the store, compared with its samples; nothing if there is none.
// Throws schema::Damage or what restore() throws, with the bare reason.
std::optional<engine::State> stored_state(const schema::Reader& store, std::int64_t job_id,
                                          const schema::Job& job);

// The same, with a message that names the job and what to do.
std::optional<engine::State> newest_state(const schema::Reader& store, std::int64_t job_id,
                                          const schema::Job& job);

// A snapshot of the job in the store; nothing if there is none at this time. Throws schema::Damage,
// DamagedCheckpoint or NewerCheckpoint, with a message that names the job and the snapshot.
std::optional<engine::State> snapshot_state(const schema::Reader& store, std::int64_t job_id,
                                            const schema::Job& job, double time);

// Why no job may go on from this checkpoint, or start from it: the engine that computed it gives
// other bits than this one (engine::physics_version). Nothing if it may.
std::optional<std::string> foreign_physics(const schema::Checkpoint& checkpoint);

// The newest state, as above, for a job that goes on from it. Throws DamagedCheckpoint also if its
// physics version is another one.
std::optional<engine::State> state_to_go_on_from(const schema::Reader& store, std::int64_t job_id,
                                                 const schema::Job& job);

}  // namespace haff::campaign
