// SPDX-License-Identifier: GPL-3.0-or-later

// How accurate a store's results are, where the errors come from, and what less of them would cost.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/statistics/accuracy.hpp"
#include "campaign/accuracy/quantity.hpp"

namespace haff::campaign {

// A quantity in one series: what chance leaves open.
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

// What moves a mean, whatever the number of realizations.
enum class SystematicEffect { finite_size, equilibration, sampling, averaging, mesh };

std::string name(SystematicEffect cause);

// The mean under a condition less the mean under a better one.
struct BiasEstimate {
  Quantity quantity;
  schema::Job job;  // of the condition
  SystematicEffect cause = SystematicEffect::finite_size;
  std::string change;  // "N = 4 000, not 32 000"
  double value = 0;
  double error = 0;  // standard error of value
};

// A cause that may move a quantity, and of which the store says nothing.
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

// Of the usual quantities, of those that have a target, and of those asked for besides. The
// interval of a series with a target is the one that its runs were added for, from the pilots'
// scatter.
Assessment assess(const std::vector<FinishedSeries>& all,
                  const std::vector<schema::Target>& targets = {},
                  const std::vector<Quantity>& asked = {});

// The same gas: equal in d, e, n and effects, whatever its size, preparation and sampling.
std::string gas_key(schema::Job job);

// The shift of gases of this size, whatever their preparation; nothing for the largest.
const BiasEstimate* finite_size_shift(const Assessment& assessment, const Statistics& statistics);

// The finite size of the gas as an error beside that of chance: its shift less what chance would
// make of none, 0 where the largest gas is meant or the shift is within its error.
double finite_size_error(const Assessment& assessment, const Statistics& statistics);

// The cheapest way to a standard error, finite size included: as large as it is seen to be, and at
// least as the error of its shift. The largest gas stands for an infinite one.
struct Offer {
  schema::Job job;
  std::size_t realizations = 0;
  double cpu_seconds = 0;
  double finite_size = 0;  // part of the error
  std::size_t seen = 0;    // runs that its scatter is known from
};
// `gas` names one, by its key. Nothing if no size of it has an error (and a tau_c in each run, if
// that is asked for), or each is too small.
std::optional<Offer> cheapest(const Assessment& assessment, const std::string& gas,
                              const Quantity& quantity, double target);

// Whether a smaller gas might do for less, and is not offered for the sole reason that its shift is
// not known well enough: more runs of the largest gas may tell.
bool smaller_might_do(const Assessment& assessment, const std::string& gas,
                      const Quantity& quantity, double target);

}  // namespace haff::campaign
