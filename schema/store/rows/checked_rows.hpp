// SPDX-License-Identifier: GPL-3.0-or-later

// Rows of the store's tables as the structs of store.hpp, each checked as far as a row can be
// checked by itself: BadValue (column.hpp) if this program would not have written it. Private to
// schema/.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <optional>
#include <string>

#include "schema/rows/column.hpp"
#include "schema/store/reader.hpp"

namespace haff::schema {

Job job_of(const SQLite::Statement& row);
JobRow job_row(const SQLite::Statement& row);
Owner owner(const SQLite::Statement& row);
Progress progress_of(const SQLite::Statement& row);
Sample sample(const SQLite::Statement& row);
CheckpointInfo checkpoint_info(const SQLite::Statement& row);
SnapshotInfo snapshot_info(const SQLite::Statement& row);
// Of a row of fields with the column d of its job: as many values as its cells hold.
Field field_of(const SQLite::Statement& row);
std::vector<std::uint64_t> pilots(const SQLite::Statement& row);

// [1,2,3], as in the column targets.pilots. And back.
std::string seeds_text(const std::vector<std::uint64_t>& seeds);
std::vector<std::uint64_t> seeds_in(const std::string& text);

// SQL: the CPU time that a job of the table `jobs` is expected to need to get :tau further, or to
// its end. [s] 0 where nothing is known.
inline constexpr const char* seconds_to_next_tau =
    "(coalesce(jobs.expected_cpu_seconds, 0) * min(:tau, jobs.tau_max - jobs.tau_reached) / "
    "jobs.tau_max)";

// SQL: the jobs that can be claimed, as `jobs`, in the order of the index: a claim takes the first
// and reads no further. SQLite would rather collect all that are pending, and sort them.
inline constexpr const char* from_claimable_jobs =
    "FROM jobs INDEXED BY jobs_to_claim "
    "LEFT JOIN jobs AS equilibration ON equilibration.job_id = jobs.equilibration_id "
    "WHERE jobs.status = 'pending' "
    "AND (jobs.kind = 'equilibration' OR equilibration.status = 'done') ";

// What would happen to this job if it were added to the store as it is.
Outcome outcome(SQLite::Database& sqlite, const Planned& planned);

}  // namespace haff::schema
