// SPDX-License-Identifier: GPL-3.0-or-later

// The cost of a wanted error: the cheapest gas, with the error of finite size included.
#pragma once

#include <optional>
#include <string>

#include "campaign/accuracy/assessment.hpp"

namespace haff::campaign {

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

// Whether a smaller gas might cost less, and is not offered only because its shift is too
// uncertain: more runs of the largest gas may help.
bool smaller_might_do(const Assessment& assessment, const std::string& gas,
                      const Quantity& quantity, double target);

}  // namespace haff::campaign
