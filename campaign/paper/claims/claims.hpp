// SPDX-License-Identifier: GPL-3.0-or-later

// The claims of the table of agreement, by subject. Each function adds those that the averages have
// data for.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "analysis/statistics/accuracy.hpp"
#include "campaign/paper/claims/agreement.hpp"
#include "campaign/paper/claims/judgement.hpp"
#include "campaign/results/averages.hpp"

namespace haff::campaign {

using Table = std::vector<Comparison>;

void add_cooling(const Averages& averages, Table& table);       // tau_c, E, gamma, b, late decay
void add_velocities(const Averages& averages, Table& table);    // a_2, a_3, a_4
void add_correlations(const Averages& averages, Table& table);  // G, its scaling
void add_clusters(const Averages& averages, Table& table);      // the largest one, S(k)

inline constexpr const char* of_the_paper = "Kawahara and Nakanishi";

// Half the 95 % interval of a mean over realizations; NaN for one.
inline double half_interval_of(const analysis::Estimate& estimate) {
  return estimate.count < 2 ? Comparison::none : analysis::half_interval(estimate, estimate.count);
}

}  // namespace haff::campaign
