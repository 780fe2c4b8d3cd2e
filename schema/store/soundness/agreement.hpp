// SPDX-License-Identifier: GPL-3.0-or-later

// What is computed a second time must come out as it did the first time, since the same job gives
// the same bits: samples that a job had stored before it began again, and those of other jobs with
// the same physics, which observe more or less of the same gas. Private to schema/.
#pragma once

#include <cstdint>

#include "schema/database/database.hpp"
#include "schema/store/store.hpp"

namespace haff::schema {

// Holds a sample against the one that the job has at the same tau. Throws Damage, naming column and
// both values, if a column that both have is another; the last digits of a logarithm or a transform
// may differ between two machines.
void must_agree(Database& database, std::int64_t job_id, const Sample& again);

// The same of a snapshot at the same time, by the checksum of its bytes.
void must_agree(Database& database, std::int64_t job_id, const Snapshot& again, std::uint64_t sum);

// Holds all samples of a job against those of finished jobs with the same physics, wherever they
// were taken at the same tau. Throws Damage, which names the other job too.
void must_agree_with_same_physics(Database& database, std::int64_t job_id);

}  // namespace haff::schema
