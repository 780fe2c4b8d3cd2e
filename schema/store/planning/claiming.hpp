// SPDX-License-Identifier: GPL-3.0-or-later

// How jobs are added, counted, looked for and claimed, whether all of them or some that were
// chosen. Private to schema/.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <optional>
#include <string>

#include "schema/store/store.hpp"

namespace haff::schema {

class Database;

// Of the jobs that this SQL gives, a table or a SELECT in brackets with the columns of jobs.
Summary summary_of(SQLite::Database& sqlite, const std::string& jobs);

// The order in which jobs are claimed: equilibrations first, then what takes longest, so that the
// last ones to finish are short.
inline constexpr const char* usual_order =
    "jobs.kind = 'equilibration' DESC, "
    "coalesce(jobs.expected_cpu_seconds, 0) * (1 - jobs.tau_reached / jobs.tau_max) DESC, "
    "jobs.particles * (jobs.tau_max - jobs.tau_reached) DESC, "
    "jobs.job_id";

// Claims the first job whose number this SELECT gives, which knows :seconds and :tau of `fit`. To
// be called within a transaction.
std::optional<Claim> claim_first(Database& database, const std::string& select, const Owner& owner,
                                 const std::string& code_version, const std::optional<Fit>& fit);

// Adds a job, or extends it. The same.
Outcome add_or_extend(Database& database, const Planned& planned);

// Binds :seconds and :tau.
void bind_fit(SQLite::Statement& statement, const std::optional<Fit>& fit);

}  // namespace haff::schema
