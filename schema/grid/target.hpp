// SPDX-License-Identifier: GPL-3.0-or-later

// A standard error that a series is to reach by as many realizations as it takes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace haff::schema {

// The interval about the mean rests on the scatter of the pilot runs
// (analysis/statistics/accuracy.hpp), which fewer runs do not tell well enough: with 5 of them it
// is 2.8 standard errors to either side instead of 2, with 3 it would be 4.3. Their forecast of the
// number of realizations is right within a factor of about 2.
inline constexpr std::size_t fewest_pilots = 5;

// What a target was expected to take when its pilot runs were done.
struct CostPrediction {
  std::size_t realizations = 0;  // in all, pilot runs included
  double cpu_seconds = 0;        // of them all, equilibrations included [s]
};

struct Target {
  std::string series;                             // identity of its jobs, without the seed
  std::string quantity;                           // a2, a3, a4, gamma_ratio or tau_c
  double tau_from = 0, tau_to = 0;                // window of the mean; 0, 0 for tau_c
  double se = 0;                                  // standard error to reach
  std::vector<std::uint64_t> pilots = {};         // seeds the interval rests on
  std::optional<CostPrediction> prediction = {};  // for this standard error
};

}  // namespace haff::schema
