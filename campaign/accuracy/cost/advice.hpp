// SPDX-License-Identifier: GPL-3.0-or-later

// The cheapest way to a smaller error of each quantity of each gas.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "campaign/accuracy/cost/target.hpp"
#include "campaign/accuracy/offer.hpp"
#include "campaign/planning/forecast.hpp"

namespace haff::campaign {

struct Advice {
  Quantity quantity;
  std::string gas;
  schema::Job job;
  double target = 0;
  std::optional<Offer> offer = {};
  double memory_bytes = 0;  // of the offer
  std::vector<std::string> notes = {};
};

// One piece of advice for each gas, quantity and target, in the order of the statistics. Without
// targets, today's errors and a tenth of them are taken.
std::vector<Advice> advice(const Assessment& assessment, const std::vector<CostTarget>& targets,
                           Forecast& forecast);

// The quantities that targets ask for and that are not among the usual ones.
std::vector<Quantity> asked_by(const std::vector<CostTarget>& targets);

}  // namespace haff::campaign
