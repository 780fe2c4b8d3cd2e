// SPDX-License-Identifier: GPL-3.0-or-later

// What captions say of measured curves: where they come from, and what their errors are.
#pragma once

#include <string>
#include <vector>

#include "campaign/results/averages.hpp"

namespace haff::campaign {

// Where the measured curves, which have n or e in common, come from, for captions: "n = 0.40;
// e = 0.80, 0.90: N = 32 000, mean of 2 realizations. haff 0.1.0 (1a2b3c4d)." Realizations that
// ended earlier, or are not done, are said.
std::string provenance(const std::vector<MeanSeries>& series);

// The programs that made them, for captions: " haff 0.1.0 (1a2b3c4d)."; nothing if unknown.
std::string versions_text(const std::vector<MeanSeries>& series);

// What captions say of error bars and bands, if any series has them, and of what they do not say:
// curves are not independent of each other, nor their points.
std::string error_note(const std::vector<MeanSeries>& series);

// Likewise of Laguerre coefficients, whose errors are never less than those of Gaussian velocities.
std::string coefficient_error_note(const std::vector<MeanSeries>& series);

// What theories with correlations take as the pair correlation at contact.
std::string contact_value_note();

}  // namespace haff::campaign
