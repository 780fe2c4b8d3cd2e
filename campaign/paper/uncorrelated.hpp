// SPDX-License-Identifier: GPL-3.0-or-later

// What a gas without velocity correlations does, as curves: the Enskog-Boltzmann equation itself,
// by direct simulation (analysis/direct), and to first order in a_2, as the paper has it. The
// latter falls 6 to 12 % short.
#pragma once

#include <optional>
#include <string_view>

#include "campaign/plot/plot.hpp"

namespace haff::campaign {

// "a2", "a3", "a4" or "gamma_ratio" against tau up to `end`, a line with its error as a band;
// beyond tau = 15 the state no longer changes. Nothing where the table of direct simulations lacks
// e.
std::optional<Curve> direct_curve(std::string_view quantity, double e, double end);

// "a2" or "gamma_ratio", dashed. Throws std::invalid_argument for another quantity.
Curve first_order_curve(std::string_view quantity, double e, double end);

}  // namespace haff::campaign
