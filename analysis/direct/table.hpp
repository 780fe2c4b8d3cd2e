// SPDX-License-Identifier: GPL-3.0-or-later

// The results of the direct simulation for the usual e, kept in enskog_boltzmann.csv. make_table
// wrote the file, and it is part of the program. The table has 128 realizations of 10^5 particles
// each, sampled up to tau = 14, and, as the state that no longer changes, the mean of 64 of them
// over 15 <= tau <= 35.
//
//   const auto a2 = tabulated("a2", 0.85, 3);
//   if (a2) draw(a2->at(tau).value, a2->at(tau).error);
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace haff::analysis {

struct TabulatedValue {
  double value = 0;
  double error = 0;  // standard error
};

struct TabulatedCurve {
  std::vector<double> tau;  // from 0 on
  std::vector<TabulatedValue> points;
  TabulatedValue plateau;  // from the last tau on

  // Cubic spline between points; the plateau beyond the last point. tau >= 0.
  TabulatedValue at(double t) const;
};

// a2 ... a6, gamma_ratio (gamma/gamma_0) or rate_ratio (omega/omega_0) against tau. Nothing for an
// e or d that is not in the table. Throws std::invalid_argument for any other quantity.
std::optional<TabulatedCurve> tabulated(std::string_view quantity, double e, int d = 3);

// The values of e that the table has for this d, increasing.
std::vector<double> tabulated_restitutions(int d = 3);

}  // namespace haff::analysis
