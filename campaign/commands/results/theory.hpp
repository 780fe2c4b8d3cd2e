// SPDX-License-Identifier: GPL-3.0-or-later

// `campaign theory`: a theory curve as a table, CSV or JSON.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/theory/correlations.hpp"
#include "campaign/commands/results/query.hpp"

namespace haff::campaign {

struct TheoryOptions {
  std::string curve;
  bool list = false;
  int d = 3;
  std::vector<double> e = {0.85};
  std::vector<double> n = {0.4};
  std::vector<double> tau, r, k;  // empty: the usual ones
  double b = analysis::cutoff_b;
  std::string effects = "{}";  // as in a grid
  std::uint32_t particles = 100'000;
  std::uint32_t realizations = 16;
  std::uint64_t seed = 1;
  RowFormat format = RowFormat::table;
};

// A number, a list 1,2,5 or FROM:TO:STEP with both ends. Nothing for anything else, or for more
// than a million values.
std::optional<std::vector<double>> values_from_text(std::string_view text);

// Prints the curve; returns an ExitCode. Throws TheoryError.
int theory(const TheoryOptions& options);

}  // namespace haff::campaign
