// `campaign cost`: what accuracy costs in time, from what the store holds.
//
// For each quantity: its error beside the CPU seconds spent, the part of chance (realizations, N)
// apart from what no number of realizations removes; and for a wanted error the cheapest gas. A
// table on `report`; cost.csv (the same with all digits, and the scatter of group means) and a
// log-log figure of each gas in the folder.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <ostream>
#include <string>
#include <utility>

#include "schema/store.hpp"

namespace haff::campaign {

struct CostRequest {
  std::filesystem::path out = "cost";          // made if it is not there
  std::map<std::string, double> targets = {};  // by the name of a quantity; else a tenth of today's
};

// "a2=5e-4"; nothing if it names no quantity of the table, or no error above 0.
std::optional<std::pair<std::string, double>> target_from_text(const std::string& text);

// Returns an exit code: 0, or 1 if no cooling run is done yet (it says what to plan) or gnuplot is
// not installed (table and CSV are there). Throws std::runtime_error if a file cannot be written,
// and the errors of the store.
int cost(const schema::Reader& store, const CostRequest& request, std::ostream& report);

}  // namespace haff::campaign
