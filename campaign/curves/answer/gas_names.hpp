// SPDX-License-Identifier: GPL-3.0-or-later

// By which parameters the gases of a picture are told apart, and how these are written.
#pragma once

#include <string>
#include <vector>

#include "campaign/curves/gas_curves.hpp"
#include "campaign/curves/question.hpp"

namespace haff::campaign {

// Names of parameters, for the legend: those asked for first, then whatever else varies.
std::vector<std::string> names_for(const Question& question, const std::vector<GasCurve>& curves);

void sort_by(const std::vector<std::string>& names, std::vector<GasCurve>& curves);

// The value of a parameter, as the legend writes it.
std::string number_of(const std::string& name, const ParameterValue& value);

// The name of a parameter, as the legend writes it where the axis of x is `variable`.
std::string word_for(const std::string& name, const std::string& variable);

// "e = 0.9, N = 8 000": in enhanced text for a legend, plain for tables and captions.
std::string label_of(const Scene& scene, const std::vector<std::string>& names, bool enhanced,
                     const std::string& variable = {});

}  // namespace haff::campaign
