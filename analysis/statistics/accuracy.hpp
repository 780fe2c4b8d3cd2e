// SPDX-License-Identifier: GPL-3.0-or-later

// What a mean of few independent values is worth, and how many a wanted error takes.
//
//   interval of the mean:  mean +- t s / sqrt(R),  t the two-sided quantile of Student's
//                          distribution with as many degrees as s has: exact for normal values
//   group means:           means of g values each scatter by s g^-1/2 if values are independent
//   until it is enough:    while s_R / sqrt(R) of all R values exceeds se, go on to min(2 R,
//                          s_R^2 / se^2) of them. How many there will be depends on scatters alone,
//                          and the mean of normal values does not: it is unbiased (of a skewed
//                          distribution it is not quite: few large values make both), and
//                          mean +- t s / sqrt(R) with the s of the R_0 pilot values and R_0 - 1
//                          degrees keeps its coverage exactly, as in the two stages of C. Stein,
//                          Ann. Math. Stat. 16, 243 (1945). With s_R in its place the interval
//                          would be too narrow: a sample that stops because s_R is small is often a
//                          lucky one (5 pilots: 92 % instead of 95 %).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "analysis/statistics/statistics.hpp"

namespace haff::analysis {

inline constexpr double usual_confidence = 0.95;

// That of one standard deviation to either side of a normal mean: of error bars.
inline constexpr double bar_confidence = 0.682689;

// Standard errors that an interval of this confidence extends to either side: 12.7, 2.78, 1.96 for
// 0.95 and 1, 4, many degrees of freedom. Throws std::invalid_argument for none.
double student_t(std::size_t degrees, double confidence = usual_confidence);

// sqrt(sum (x - mean)^2 / (N - 1)): of one value, where estimate() gives that of the mean.
double standard_deviation(const Estimate& estimate);

// Half the interval of the mean of `count` values that scatter as these do, which are among them:
// all of them, or the pilot values where scatter has decided how many there are.
double half_interval(const Estimate& scatter, std::size_t count,
                     double confidence = usual_confidence);

// Means of disjoint groups of neighbouring values.
struct GroupScatter {
  std::size_t size = 1;    // of a group
  std::size_t groups = 0;  // complete ones; values left over are not used
  double scatter = 0;      // standard deviation of their means: the measured error of such a mean
  double error = 0;        // of scatter, sqrt(1 / (2 (groups - 1))) of it, for normal means
};

// Groups of 1, 2, 4, ... values, while there are at least `fewest_groups`.
std::vector<GroupScatter> group_scatter(std::span<const double> values,
                                        std::size_t fewest_groups = 4);

// The power with which scatter falls with the size of the groups: a straight line through
// ln scatter + 1/(2 (groups - 1)), which is unbiased for normal means to that order, weighed by
// groups - 1. Its error is the spread of 1000 sets of as many independent normal values, drawn by
// GSL's mt19937 with a fixed seed; their slope is -1/2. Throws std::invalid_argument for fewer than
// two sizes.
struct Slope {
  double value = 0;
  double error = 0;
};
Slope scatter_slope(std::span<const GroupScatter> scatter);

// Values in all, so that deviation / sqrt(R) <= se; two at least, to say so. Throws
// std::invalid_argument unless se > 0.
std::size_t realizations_needed(double deviation, double se);

// Values to go on to: `so_far.count` if they are enough, else at most twice as many. Throws
// std::invalid_argument for fewer than two values, or unless se > 0.
std::size_t next_realizations(const Estimate& so_far, double se);

}  // namespace haff::analysis
