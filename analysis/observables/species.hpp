// SPDX-License-Identifier: GPL-3.0-or-later

// The temperatures of the two species of a mixture, T_i = (m_i/d) <v^2> over species i.
#pragma once

#include <array>
#include <span>
#include <vector>

namespace haff::analysis {

// The temperatures of the first and of the second species, in units of mass times velocity squared.
// `is_second` says for each velocity whether it belongs to the second species; the lengths must
// agree (std::invalid_argument). NaN for a species that has no particle.
std::array<double, 2> species_temperatures(std::span<const std::array<double, 3>> velocities,
                                           const std::vector<bool>& is_second,
                                           std::array<double, 2> mass, int d = 3);

}  // namespace haff::analysis
