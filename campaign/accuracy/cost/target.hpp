// SPDX-License-Identifier: GPL-3.0-or-later

// An error that is wanted of a quantity, as `campaign cost --target` names it.
#pragma once

#include <optional>
#include <string>

#include "campaign/accuracy/quantity.hpp"

namespace haff::campaign {

// An error that is wanted: of one quantity, or of all that the table has of a measure.
struct CostTarget {
  Measure measure = Measure::a2;
  std::optional<Quantity> quantity = {};
  double error = 0;

  bool operator==(const CostTarget&) const = default;
};

// "a2=5e-4", or with a window of tau as a grid's target has one, "a2@3:8=5e-4"; at one tau
// "gamma_ratio@20=1e-3" (2 to either side), "ln_temperature@50=0.01", "G_parallel@50=1e-5". Nothing
// if it names no quantity, a window that the quantity cannot have, or no error above 0.
std::optional<CostTarget> target_from_text(const std::string& text);

// Whether the target asks for an error of this quantity.
bool is_meant(const CostTarget& target, const Quantity& quantity);

}  // namespace haff::campaign
