// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/paper/claims/judgement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace haff::campaign {

Judgement judge(double value, double half_interval, double reference,
                const std::vector<Rival>& rivals, double most) {
  const auto distance = [&](const Rival& rival) { return std::abs(rival.value - reference); };
  const auto nearest = std::ranges::min_element(rivals, {}, distance);
  const double half_way =
      nearest == rivals.end() ? std::numeric_limits<double>::infinity() : distance(*nearest) / 2;
  const double tolerance = std::min(most, half_way);
  Judgement judgement{.criterion = fmt::format("± {:.2g}", tolerance)};
  if (half_way <= most)
    judgement.criterion += fmt::format(": half way to {}, {:.4g}", nearest->name, nearest->value);
  const double difference = std::abs(value - reference);
  const double open = std::isfinite(half_interval) ? half_interval : 0;
  if (difference > tolerance + open)
    judgement.holds = false;
  else if (half_interval <= tolerance)  // not for NaN
    judgement.holds = difference <= tolerance;
  else
    judgement.criterion += std::isfinite(half_interval) ? "; the error is too large to tell"
                                                        : "; one realization is too few to tell";
  return judgement;
}

}  // namespace haff::campaign
