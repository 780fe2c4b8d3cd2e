// SPDX-License-Identifier: GPL-3.0-or-later

// Means over intervals of tau, for what is noise in a single sample: each point's error is that of
// the realizations' means over the interval, so that it knows how neighbouring samples are
// correlated.
#pragma once

#include "campaign/plot/plot.hpp"
#include "campaign/results/averages.hpp"

namespace haff::campaign {

// How long a_2 near the Gaussian remembers: 1.94 in tau (tests/campaign/accuracy/assessment.cpp).
inline constexpr double a2_correlation_time = 1.94;

enum class RunValue { a2, gamma_ratio };

struct Intervals {
  double from = 0;   // tau: before, each sample is a point of its own
  double width = 1;  // tau
};

// Adds the points until tau = end to the curve: x, y, error (as in Means; of a_2 at least that of
// Gaussian velocities) and realizations. A decay rate belongs to the middle of the time before its
// sample; there is none before the first.
void add_interval_means(const MeanSeries& series, RunValue value, const Intervals& intervals,
                        double end, Curve& curve);

}  // namespace haff::campaign
