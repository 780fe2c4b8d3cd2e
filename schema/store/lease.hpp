// SPDX-License-Identifier: GPL-3.0-or-later

// The right to write to a job: whether it is held, and its end. Private to schema/.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>

#include "schema/database/database.hpp"
#include "schema/store/store.hpp"

namespace haff::schema {

// Whether the job is held under this lease.
bool holds(Database& database, const Lease& lease);

// Throws LeaseLost if it is not, Damage if the row of the job is not as it was written.
void must_hold(Database& database, const Lease& lease);

// Whether the row of this job is as it was written. If it is not, the job fails: nothing works on
// it any more, and its row stays known as wrong until `verify --repair` puts it right.
bool is_as_written(Database& database, std::int64_t job_id);

// For the end of a lease: false if the row of its job was not as it was written. Throws LeaseLost.
bool is_held(Database& database, const Lease& lease);

// Notes how far the job is.
void note_progress(Database& database, const Lease& lease, const Progress& progress);

// The end of a lease. The job is where its last checkpoint is.
void leave(Database& database, const Lease& lease, Status status);

}  // namespace haff::schema
