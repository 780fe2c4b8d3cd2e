// SPDX-License-Identifier: GPL-3.0-or-later

// Causes that shift the mean of a quantity, whatever the number of realizations, as far as the
// series of a gas show them.
#pragma once

#include <string>
#include <vector>

#include "campaign/accuracy/quantity.hpp"

namespace haff::campaign {

// A cause that shifts a mean, whatever the number of realizations.
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

// From all series of one gas: of its size and preparation, where it has several, and of how its
// runs were looked at.
std::vector<BiasEstimate> shifts_of(const Quantity& quantity,
                                    const std::vector<const FinishedSeries*>& gas);

// Whether the cause may move the quantity at all: a correlation is of one state, others of samples.
bool is_moved(const Quantity& quantity, SystematicEffect cause);

// The same gas: equal in d, e, n and effects, whatever its size, preparation and sampling.
std::string gas_key(schema::Job job);

}  // namespace haff::campaign
