// SPDX-License-Identifier: GPL-3.0-or-later

// What is wrong with one job in the store: its state, its samples, its profiles, its results.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "schema/store/store.hpp"

namespace haff::campaign {

struct JobFaults {
  std::optional<std::string> state = {};  // why the job cannot go on from its state
  std::optional<std::string> newer = {};  // its state is sound, but of a newer program
  std::vector<std::string> rows = {};     // of samples, profiles, fields, results, invariants
  bool lacks_digests = false;             // a program of an older version wrote some of its rows

  bool empty() const { return !state && !newer && rows.empty(); }
};

// A job that is being worked on may be examined, too. A failure of the system to read is thrown as
// schema::Unavailable: it is no fault of the job.
JobFaults faults_of(const schema::Reader& store, const schema::JobRow& row);

}  // namespace haff::campaign
