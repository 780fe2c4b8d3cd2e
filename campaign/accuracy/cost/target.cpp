// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/accuracy/cost/target.hpp"

#include <algorithm>

#include "campaign/base/text/number_text.hpp"

namespace haff::campaign {

std::optional<CostTarget> target_from_text(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos) return std::nullopt;
  const auto at = std::min(text.find('@'), equals);
  const auto measure = measure_named(text.substr(0, at));
  const auto error = number_in(text.substr(equals + 1));
  if (!measure || !error || !(*error > 0)) return std::nullopt;
  CostTarget target{.measure = *measure, .error = *error};
  if (at < equals) {
    target.quantity = quantity_at(*measure, text.substr(at + 1, equals - at - 1));
    if (!target.quantity) return std::nullopt;
  }
  return target;
}

bool is_meant(const CostTarget& target, const Quantity& quantity) {
  return target.quantity ? *target.quantity == quantity : target.measure == quantity.measure;
}

}  // namespace haff::campaign
