// SPDX-License-Identifier: GPL-3.0-or-later

// Differences between gases that started from the same states, seed by seed: those of different e,
// or with and without an effect that leaves equilibrium as it is. Fluctuations that both share
// cancel in such a difference, so that its error is often smaller at no cost.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "campaign/accuracy/quantity.hpp"

namespace haff::campaign {

// Names the equilibrated states that runs start from: of equal text, runs of one seed start from
// the same state.
std::string common_start(const schema::Job& job);

struct PairedDifference {
  std::size_t pairs = 0;   // seeds that both have, two at least
  double value = 0;        // mean of ours less theirs
  double error = 0;        // standard error of value
  double independent = 0;  // what it would be with as many independent seeds
};

// Of values by seed; nothing of fewer than two seeds that both have.
std::optional<PairedDifference> paired_difference(const std::map<std::uint64_t, double>& ours,
                                                  const std::map<std::uint64_t, double>& theirs);

struct Difference {
  Quantity quantity;
  schema::Job job, reference;  // of one seed each
  PairedDifference difference;
};

// Of each series and the next one that shares its equilibrations, for these quantities.
std::vector<Difference> paired_differences(const std::vector<FinishedSeries>& all,
                                           const std::vector<Quantity>& quantities);

}  // namespace haff::campaign
