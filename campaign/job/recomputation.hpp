// SPDX-License-Identifier: GPL-3.0-or-later

// A finished job, computed once more from its parameters and the state that it starts from. The
// same job gives the same bits: results differ from those in the store only if one of the two was
// disturbed.
#pragma once

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "schema/store/store.hpp"

namespace haff::campaign {

// This program cannot compute the job's bits again: they are of another physics version.
struct OtherPhysics : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The results, in a store of their own that is deleted with this object. Beside a cooling job there
// is a copy of its equilibration.
struct Recomputation {
  schema::Store store;
  std::int64_t job_id = 0;  // in this store
};

// Computes a job that is done or collapsed again; nothing is written to `store`. Throws
// OtherPhysics; schema::Damage or DamagedCheckpoint if the state it starts from cannot be used;
// what the engine throws.
Recomputation recompute(const schema::Reader& store, const schema::JobRow& row);

// The parts that a second computation gives. A job also has its row, its cost and its newest state.
inline constexpr std::array computed_parts{schema::Part::samples, schema::Part::profiles,
                                           schema::Part::fields, schema::Part::snapshots,
                                           schema::Part::results};

// Every value of these parts, and of the last state of an equilibration, that is not the same in
// all bits.
std::vector<schema::Difference> differences(const schema::Reader& store, const schema::JobRow& row,
                                            const Recomputation& again);

}  // namespace haff::campaign
