// SPDX-License-Identifier: GPL-3.0-or-later

// The gases of the paper, R. Kawahara and H. Nakanishi, cond-mat/0309130.
#pragma once

namespace haff::campaign {

// The density of the paper's base case [sigma^-d].
inline constexpr double base_density = 0.40;

// e of the paper's figures over densities.
inline constexpr double densities_restitution = 0.85;

// e of the paper's velocity correlations, and tau between which they scale.
inline constexpr double correlations_restitution = 0.80;
inline constexpr double scaling_from = 20, scaling_until = 60;

}  // namespace haff::campaign
