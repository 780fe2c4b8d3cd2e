// SPDX-License-Identifier: GPL-3.0-or-later

// `campaign explain JOB`: why a job is where it is, and what happens next.
#pragma once

#include <cstdint>
#include <filesystem>

namespace haff::campaign {

// Prints it, for people or as JSON; returns an ExitCode. Throws schema::NameError if there is no
// such job.
int explain_job(const std::filesystem::path& store, std::int64_t job_id, bool json);

}  // namespace haff::campaign
