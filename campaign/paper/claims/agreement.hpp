// SPDX-License-Identifier: GPL-3.0-or-later

// What the simulations say beside what is published and what theory gives: each claim with its
// number, its 95 % interval, what it is compared with and what it is held to (judgement.hpp).
//
// Claims: R. Kawahara and H. Nakanishi, cond-mat/0309130. Theory: the analysis room.
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "campaign/results/averages.hpp"

namespace haff::campaign {

struct Comparison {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  std::string claim;     // one word or two for programs: "tau_c", "energy", ...
  std::string quantity;  // in words
  std::optional<double> e = {}, n = {};
  double value = none;
  double half_interval = none;  // of 95 %, of the mean over realizations by Student's t
  double reference = none;      // what value is compared with
  std::string source = {};      // of reference
  std::string criterion = {};
  std::optional<bool> holds = {};  // nothing: said, but not judged
  std::string note = {};
};

// All that the averages have data for, in the order of the paper.
std::vector<Comparison> agreement(const Averages& averages);

// The table, reals with 17 digits, absent values empty. Throws std::runtime_error if it cannot be
// written.
void write_agreement(const std::vector<Comparison>& table, const std::filesystem::path& file);

}  // namespace haff::campaign
