// SPDX-License-Identifier: GPL-3.0-or-later

// How accurate a store's results are, and where the errors come from.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/statistics/accuracy.hpp"
#include "campaign/accuracy/quantity.hpp"
#include "campaign/accuracy/systematic.hpp"

namespace haff::campaign {

// A quantity in one series with its statistical error.
struct Statistics {
  Quantity quantity;
  schema::Job job;
  std::size_t realizations = 0;
  double mean = 0;
  double error = 0;  // standard error; of one realization from blocks of samples, NaN if none
  double half_interval = 0;       // of 95 %, Student's; NaN for one realization
  std::size_t interval_runs = 0;  // that its scatter is of: all, or the pilots of a target
  double deviation = 0;           // of one realization; of a single one by its blocks, or NaN
  double cpu_seconds = 0;         // of one realization, as far as the quantity needs it
  std::size_t unfinished = 0;  // runs that ended before their tau_c: the mean is of the early ones
  std::optional<double> correlation_time = {};  // [tau], where the error comes from blocks
  std::vector<analysis::GroupScatter> scatter = {};
  std::optional<analysis::Slope> slope = {};  // of scatter; -1/2 for independent realizations
};

// A cause that may shift a quantity, and about which the store says nothing.
struct UnknownBias {
  SystematicEffect cause;
  Quantity quantity;
  schema::Job job;  // one of the gas
};

// A quantity that no run of a gas has.
struct NotMeasured {
  Quantity quantity;
  schema::Job job;       // one of the gas
  bool reached = false;  // a run is long enough: it was not measured
};

struct Assessment {
  std::vector<Statistics> statistics;  // by gas, quantity, series
  std::vector<BiasEstimate> shifts;    // by gas, quantity, cause
  std::vector<UnknownBias> unknown;    // likewise
  std::vector<NotMeasured> absent;
};

// For the usual quantities, those that have a target, and those that are asked for. A series with a
// target has the interval for which its runs were added, from the scatter of the pilot runs.
Assessment assess(const std::vector<FinishedSeries>& all,
                  const std::vector<schema::Target>& targets = {},
                  const std::vector<Quantity>& asked = {});

}  // namespace haff::campaign
