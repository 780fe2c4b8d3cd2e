// SPDX-License-Identifier: GPL-3.0-or-later

// Quantities that are fitted to each realization by itself and then averaged: the spread over
// realizations is an honest error, that of one fit to correlated samples is not. A realization to
// which the fit fails is left out: the estimate's count says how many there were.
#pragma once

#include <optional>
#include <vector>

#include "analysis/statistics/statistics.hpp"
#include "campaign/results/averages.hpp"

namespace haff::campaign {

// The cutoff number b of the energy equation with the loss of Enskog-Boltzmann theory (analysis/
// energy_equation.hpp), from ln E until tau_c or the end of the series. The standard error is NaN
// for one realization.
std::optional<analysis::Estimate> fitted_cutoff(const MeanSeries& series);

// The exponent of T ~ tau^-exponent beyond the homogeneous stage, from 2 tau_c to the end of the
// series. Nothing unless some realization went well beyond 2 tau_c.
std::optional<analysis::Estimate> late_exponent(const MeanSeries& series);

// The same in each third of that range of ln tau: equal where T is a power of tau. Nothing
// likewise.
std::vector<analysis::Estimate> late_local_exponents(const MeanSeries& series);

}  // namespace haff::campaign
