// SPDX-License-Identifier: GPL-3.0-or-later

// `campaign cost`: what accuracy costs in time, from what the store holds.
//
// For each quantity: its error beside the CPU seconds spent, where chance (realizations, N) is kept
// apart from what no number of realizations removes; and for a wanted error the cheapest gas. A
// table on `report`; cost.csv (the same with all digits, and the scatter of group means) and a
// log-log figure of each gas in the folder.
#pragma once

#include <filesystem>
#include <ostream>
#include <vector>

#include "campaign/accuracy/cost/target.hpp"
#include "schema/store/store.hpp"

namespace haff::campaign {

struct CostRequest {
  std::filesystem::path out = "cost";    // made if it is not there
  std::vector<CostTarget> targets = {};  // else today's error, and a tenth of it
  bool json = false;                     // report the rows of cost.csv as JSON instead of tables
};

// Returns an exit code: 0, or 1 if no cooling run is done yet (the report says what to plan) or a
// picture could not be drawn (the table and the CSV file are there, the report says what is missing
// and why). Throws std::runtime_error if the CSV file cannot be written, and the errors of the
// store.
int cost(const schema::Reader& store, const CostRequest& request, std::ostream& report);

}  // namespace haff::campaign
