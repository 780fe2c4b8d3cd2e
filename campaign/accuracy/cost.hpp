// `campaign cost`: what accuracy costs in time, from what the store holds.
//
// For each quantity: its error beside the CPU seconds spent, the part of chance (realizations, N)
// apart from what no number of realizations removes; and for a wanted error the cheapest gas. A
// table on `report`; cost.csv (the same with all digits, and the scatter of group means) and a
// log-log figure of each gas in the folder.
#pragma once

#include <filesystem>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "campaign/accuracy/quantity.hpp"
#include "schema/store/store.hpp"

namespace haff::campaign {

// An error that is wanted: of one quantity, or of all that the table has of a measure.
struct CostTarget {
  Measure measure = Measure::a2;
  std::optional<Quantity> quantity = {};
  double error = 0;

  bool operator==(const CostTarget&) const = default;
};

struct CostRequest {
  std::filesystem::path out = "cost";    // made if it is not there
  std::vector<CostTarget> targets = {};  // else today's error, and a tenth of it
  bool json = false;                     // report the rows of cost.csv as JSON instead of tables
};

// "a2=5e-4", or with a window of tau as a grid's target has one, "a2@3:8=5e-4"; at one tau
// "gamma_ratio@20=1e-3" (2 to either side), "ln_temperature@50=0.01", "G_parallel@50=1e-5". Nothing
// if it names no quantity, a window that the quantity cannot have, or no error above 0.
std::optional<CostTarget> target_from_text(const std::string& text);

// Returns an exit code: 0, or 1 if no cooling run is done yet (the report says what to plan) or a
// picture could not be drawn (the table and the CSV file are there, the report says what is missing
// and why). Throws std::runtime_error if the CSV file cannot be written, and the errors of the
// store.
int cost(const schema::Reader& store, const CostRequest& request, std::ostream& report);

}  // namespace haff::campaign
