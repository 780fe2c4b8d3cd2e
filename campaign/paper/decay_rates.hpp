// SPDX-License-Identifier: GPL-3.0-or-later

// What figures of the decay rate gamma(tau)/gamma_0 have in common: how samples are averaged, and
// the energy equation beside them.
#pragma once

#include <string>
#include <vector>

#include "analysis/theory/energy_equation.hpp"
#include "campaign/paper/interval_means.hpp"
#include "campaign/plot/plot.hpp"

namespace haff::campaign {

// The measured rates of a gas up to `end`, as symbols. Samples of tau = 1 crowd where curves lie
// close together: from some tau on they are means over intervals.
Curve decay_rates(const MeanSeries& series, double end);

// What the caption says of that.
std::string intervals_note();

// The energy equation with the loss of Enskog-Boltzmann theory, a line; without it, as the paper
// has it, dotted.
Curve energy_equation_rates(double e, double n, double end, analysis::Velocities velocities);

// The entries of the legend for both.
std::vector<Curve> energy_equation_entries();

}  // namespace haff::campaign
