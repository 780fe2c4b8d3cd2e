// SPDX-License-Identifier: GPL-3.0-or-later

// Why a job is where it is: what it waits for, what was tried, what happens next.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "schema/store/store.hpp"

namespace haff::campaign {

struct Explanation {
  schema::JobRow row;
  // Sentences, each of one line.
  std::vector<std::string> where;      // its status, and what holds it
  std::vector<std::string> waits_for;  // empty: for nothing
  std::vector<std::string> tried;
  std::vector<std::string> next;  // what the program will do, or the user can
};

// Throws schema::NameError if there is no such job.
Explanation explain(const schema::Reader& store, std::int64_t job_id);

nlohmann::ordered_json explanation_json(const Explanation& explanation);

}  // namespace haff::campaign
