// SPDX-License-Identifier: GPL-3.0-or-later

// Means and their standard errors: over independent realizations, and over one correlated series.
//
//   standard error of N independent values: sqrt(sum (x - mean)^2 / (N (N - 1)))
//   correlated values: the standard error of the means of blocks longer than the correlation time,
//   H. Flyvbjerg and H. G. Petersen, J. Chem. Phys. 91, 461 (1989); the shortest block length B
//   with B^3 > 2 N (error with blocks / error without)^4 is long enough and leaves the most
//   blocks, R. M. Lee et al., Phys. Rev. E 83, 066706 (2011).
//
// Blocks that are not much longer than the correlation time are still correlated, and all values
// lie nearer to their own mean than to the true one. In a short series (60 samples of a heated gas,
// whose temperature is correlated over 6) both effects together made the error too small by a
// factor of 2. They are corrected as if correlations fell exponentially: rho is chosen such that
// block means would scatter as they do, and the error is that of the mean of all values with this
// rho.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace haff::analysis {

struct Estimate {
  double mean = 0;
  double standard_error = 0;  // NaN for a single value
  std::size_t count = 0;
};

// Mean of independent values, in the order given. Throws std::invalid_argument if there are none.
Estimate estimate(std::span<const double> values);

// The mean of one correlated, stationary series from blocks of 1, 2, 4, ... values, with at least
// eight blocks. The error of a series shorter than some ten correlation times is underestimated
// nevertheless.
struct BlockEstimate {
  Estimate estimate;  // its count is the number of blocks
  std::size_t block_length = 1;
  // Integrated correlation time in units of the sample interval, 1/2 for independent values:
  // (standard error / naive standard error)^2 / 2.
  double correlation_time = 0.5;
};
// Throws std::invalid_argument for fewer than two values. The relative error of the standard error
// is about 1/sqrt(2 (blocks - 1)).
BlockEstimate block_estimate(std::span<const double> series);

// The centred moving average over `window` (odd) neighbours; the window shrinks symmetrically at
// the ends. Same length as the series. Throws std::invalid_argument for an even window.
std::vector<double> smoothed(std::span<const double> series, std::size_t window);

}  // namespace haff::analysis
