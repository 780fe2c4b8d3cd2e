// SPDX-License-Identifier: GPL-3.0-or-later

// What `campaign cost` knows, row by row: cost.csv, and the same as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "campaign/accuracy/assessment.hpp"
#include "campaign/accuracy/cost/advice.hpp"

namespace haff::campaign {

// A row of cost.csv: of which quantity and gas, then what the row has. The rows are also printed as
// JSON.
struct CostRow {
  const char* row = "";
  Quantity quantity;
  schema::Job job;
  std::string cause;
  std::optional<std::size_t> realizations = {};
  std::optional<double> cpu_seconds = {}, value = {}, error = {}, interval = {}, slope = {},
                        slope_error = {}, correlation_time = {}, memory_bytes = {};
};

std::vector<CostRow> rows_of(const Assessment& assessment, const std::vector<Advice>& advised);

std::string csv_of(const std::vector<CostRow>& rows);
nlohmann::ordered_json json_of(const std::vector<CostRow>& rows);

}  // namespace haff::campaign
