// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/paper/interval_means.hpp"

#include <algorithm>
#include <cmath>

namespace haff::campaign {
namespace {

// The mean of samples first ... last - 1, over realizations.
analysis::Estimate mean_of_samples(const MeanSeries& series, RunValue value, std::size_t first,
                                   std::size_t last) {
  std::vector<double> means;
  for (const Realization& run : series.runs) {
    if (run.tau.size() < last) continue;
    const auto begin = (value == RunValue::a2 ? run.a2 : run.gamma_ratio).begin();
    means.push_back(analysis::estimate({begin + static_cast<std::ptrdiff_t>(first),
                                        begin + static_cast<std::ptrdiff_t>(last)})
                        .mean);
  }
  return analysis::estimate(means);
}

// Where the interval that begins with this sample ends.
std::size_t end_of(const MeanSeries& series, const Intervals& intervals, std::size_t first,
                   double end) {
  std::size_t last = first + 1;
  if (series.tau[first] < intervals.from) return last;
  while (last < series.tau.size() && series.tau[last] <= end &&
         series.tau[last] < series.tau[first] + intervals.width)
    ++last;
  return last;
}

// Of a mean over an interval of this width.
double error_of_interval(const MeanSeries& series, RunValue value, const analysis::Estimate& mean,
                         double width) {
  const auto runs = static_cast<std::int64_t>(mean.count);
  const double independent = std::max(1.0, width / (2 * a2_correlation_time));
  return error_of_mean(value == RunValue::a2 ? 2 : 0, mean.standard_error, runs,
                       static_cast<double>(series.particles * runs) * independent);
}

}  // namespace

void add_interval_means(const MeanSeries& series, RunValue value, const Intervals& intervals,
                        double end, Curve& curve) {
  const bool rate = value == RunValue::gamma_ratio;
  for (std::size_t i = rate ? 1 : 0; i < series.tau.size() && series.tau[i] <= end;) {
    const std::size_t last = end_of(series, intervals, i, end);
    const auto mean = mean_of_samples(series, value, i, last);
    const double width = series.tau[last - 1] - series.tau[i] + series.sample_every;
    const double middle = 0.5 * (series.tau[i] + series.tau[last - 1]);
    curve.x.push_back(rate ? middle - 0.5 * series.sample_every : middle);
    curve.y.push_back(mean.mean);
    curve.error.push_back(error_of_interval(series, value, mean, width));
    curve.realizations.push_back(static_cast<std::int64_t>(mean.count));
    i = last;
  }
}

}  // namespace haff::campaign
