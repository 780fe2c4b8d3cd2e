// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/paper/uncorrelated.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "analysis/direct/table.hpp"
#include "analysis/theory/enskog_boltzmann.hpp"

namespace haff::campaign {

std::optional<Curve> direct_curve(std::string_view quantity, double e, double end) {
  const auto table = analysis::tabulated(quantity, e);
  if (!table) return std::nullopt;
  Curve curve{.name = "Enskog-Boltzmann, direct simulation, " + std::string(quantity),
              .legend = "Enskog–Boltzmann",
              .source = Source::theory,
              .e = e,
              .width = 1.6};
  const auto add = [&](double tau, const analysis::TabulatedValue& value) {
    curve.x.push_back(tau);
    curve.y.push_back(value.value);
    curve.error.push_back(value.error);
  };
  for (std::size_t k = 0; k < table->tau.size() && table->tau[k] <= end; ++k)
    add(table->tau[k], table->points[k]);
  const double rest = table->tau.back() + 1;
  if (rest < end) add(rest, table->plateau);
  if (curve.x.back() < end) add(end, table->at(end));
  return curve;
}

Curve first_order_curve(std::string_view quantity, double e, double end) {
  if (quantity != "a2" && quantity != "gamma_ratio")
    throw std::invalid_argument("no curve of first order for " + std::string(quantity));
  Curve curve{.name = "Enskog-Boltzmann, first order, " + std::string(quantity),
              .legend = "the same to first order in {/:Italic a}_2",
              .source = Source::theory,
              .e = e,
              .look = Look::dashed,
              .width = 1.2};
  constexpr int points = 150;
  for (int i = 0; i <= points; ++i) {
    const double share = static_cast<double>(i) / points;
    const double tau = end * share * share;  // denser where it bends
    const double a2 = analysis::boltzmann_a2(tau, e);
    curve.x.push_back(tau);
    curve.y.push_back(quantity == "a2" ? a2 : analysis::boltzmann_gamma_ratio(a2));
  }
  return curve;
}

}  // namespace haff::campaign
