// SPDX-License-Identifier: GPL-3.0-or-later

// `campaign export`: the gas of a job, for other programs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>

namespace haff::campaign {

struct ExportOptions {
  std::int64_t job_id = 0;
  std::optional<double> at_tau = {}, at_time = {};  // a snapshot; neither: the last stored state
  bool all = false;                                 // every snapshot, one after the other
  bool list = false;                                // what there is
  bool json = false;                                // of the list
};

// Writes the job's last stored state, a snapshot or all of them as extended XYZ (state/
// extended_xyz.hpp), with job_id, e, n, seed, tau and time in the second line. Throws
// schema::NameError if there is no such job, no state of it or no such snapshot, DamagedCheckpoint
// if the state is damaged.
int export_state(const std::filesystem::path& store, const ExportOptions& options,
                 std::ostream& out);

}  // namespace haff::campaign
