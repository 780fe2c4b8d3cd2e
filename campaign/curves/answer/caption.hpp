// SPDX-License-Identifier: GPL-3.0-or-later

// What stands beside and below a picture in words.
#pragma once

#include <string>
#include <vector>

#include "campaign/curves/gas_curves.hpp"
#include "campaign/curves/question.hpp"

namespace haff::campaign {

// What all gases have in common, how many realizations were averaged, and what the errors are.
// `tone` is the parameter that a scale of tones shows, empty without one.
std::string caption_of(const Question& question, const Topic& topic, const GasCurves& curves,
                       const std::vector<std::string>& names, const std::string& tone);

std::string y_label(const Question& question, const Topic& topic);

}  // namespace haff::campaign
