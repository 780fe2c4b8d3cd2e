// SPDX-License-Identifier: GPL-3.0-or-later

// The accuracy of a mean of few independent values, and how many values a wanted error takes.
//
//   interval of the mean:  mean +- t s / sqrt(R), where t is the two-sided quantile of Student's
//                          distribution with as many degrees as s has: exact for normal values
//   group means:           means of g values each scatter by s g^-1/2 if values are independent
//   until it is enough:    while s_R / sqrt(R) of all R values exceeds se, go on to
//                          min(2 R, s_R^2 / se^2) values. This number depends on scatters alone,
//                          and the mean of normal values does not depend on them, so the mean is
//                          unbiased. (For a skewed distribution it is not quite unbiased, since a
//                          few large values change both.) mean +- t s / sqrt(R) with the s of the
//                          R_0 pilot values and R_0 - 1 degrees keeps its coverage exactly, as in
//                          the two stages of C. Stein, Ann. Math. Stat. 16, 243 (1945). With s_R
//                          instead the interval would be too narrow: a sample that stops because
//                          s_R is small is often a lucky one (5 pilots: 92 % instead of 95 %).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "analysis/statistics/statistics.hpp"

namespace haff::analysis {

inline constexpr double usual_confidence = 0.95;

// The confidence of error bars: one standard deviation to either side of a normal mean.
inline constexpr double bar_confidence = 0.682689;

// The number of standard errors that an interval of this confidence extends to either side: 12.7,
// 2.78, 1.96 for 0.95 and 1, 4, many degrees of freedom. Throws std::invalid_argument for zero
// degrees.
double student_t(std::size_t degrees, double confidence = usual_confidence);

// sqrt(sum (x - mean)^2 / (N - 1)): the deviation of one value; estimate() gives that of the mean.
double standard_deviation(const Estimate& estimate);

// Half the width of the interval of the mean of `count` values. `scatter` is the estimate of all of
// them, or of the pilot values alone where the scatter decided how many values there are.
double half_interval(const Estimate& scatter, std::size_t count,
                     double confidence = usual_confidence);

// Means of disjoint groups of neighbouring values.
struct GroupScatter {
  std::size_t size = 1;    // of a group
  std::size_t groups = 0;  // complete groups; values left over are not used
  double scatter = 0;      // standard deviation of their means: the measured error of such a mean
  double error = 0;        // of scatter, sqrt(1 / (2 (groups - 1))) of it, for normal means
};

// Groups of 1, 2, 4, ... values, while there are at least `fewest_groups`.
std::vector<GroupScatter> group_scatter(std::span<const double> values,
                                        std::size_t fewest_groups = 4);

// The power with which scatter falls with the size of the groups: a straight line through ln
// scatter + 1/(2 (groups - 1)), which is unbiased for normal means to that order, with weights
// groups - 1. Its error is the spread of the slopes of 1000 sets of as many independent normal
// values, whose slope is -1/2, drawn by GSL's mt19937 with a fixed seed. Throws
// std::invalid_argument for fewer than two sizes.
struct Slope {
  double value = 0;
  double error = 0;
};
Slope scatter_slope(std::span<const GroupScatter> scatter);

// The total number of values for which deviation / sqrt(R) <= se; at least two, the fewest that
// have an error. Throws std::invalid_argument unless se > 0.
std::size_t realizations_needed(double deviation, double se);

// The number of values to go on to: `so_far.count` if these suffice, otherwise at most twice as
// many. Throws std::invalid_argument for fewer than two values, or unless se > 0.
std::size_t next_realizations(const Estimate& so_far, double se);

}  // namespace haff::analysis
