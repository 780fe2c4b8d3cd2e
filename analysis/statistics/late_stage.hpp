// SPDX-License-Identifier: GPL-3.0-or-later

// The late stage: once clusters have formed, T falls roughly as a power of tau (published: tau^-3
// ... tau^-4, strongly dependent on the sample; R. Kawahara and H. Nakanishi, cond-mat/0309130).
#pragma once

#include <span>

namespace haff::analysis {

struct PowerLaw {
  double exponent = 0;  // of tau; about -3 ... -4
  // From the scatter around the line. Samples of one series are correlated, so this is a lower
  // bound: the spread of the exponents of independent realizations is the true error.
  double standard_error = 0;
  double prefactor = 0;  // T at tau = 1 [E(0)]
};

// A straight line through ln T against ln tau for from <= tau <= to (GSL's linear least squares,
// with equal weights). Throws std::invalid_argument if the lengths differ, or if fewer than three
// samples with tau > 0 and T > 0 are in the range.
PowerLaw late_exponent(std::span<const double> tau, std::span<const double> temperature,
                       double from, double to);

}  // namespace haff::analysis
