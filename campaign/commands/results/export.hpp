// SPDX-License-Identifier: GPL-3.0-or-later

// `campaign export`: the state of a job for other programs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>

namespace haff::campaign {

// Writes the job's last stored state as extended XYZ, which OVITO and ASE read: id, position,
// velocity [sqrt(E(0)/m)] and radius of every particle in order of id, the box, and job_id, e, n,
// seed, tau and time in the head. Positions and velocities have all digits. Throws
// schema::StoreError if there is no such job or no state of it, DamagedCheckpoint if it is bad.
int export_state(const std::filesystem::path& store, std::int64_t job_id, std::ostream& out);

}  // namespace haff::campaign
