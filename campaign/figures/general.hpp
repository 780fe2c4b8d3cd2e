// SPDX-License-Identifier: GPL-3.0-or-later

// Figures of any store: the questions that one asks first of any gas, each gas a curve.
#pragma once

#include <span>
#include <string_view>

#include "campaign/curves/question.hpp"

namespace haff::campaign {

struct GeneralFigure {
  std::string_view name;  // of its files, after "gas-"
  std::string_view title;
  Question question;
};

std::span<const GeneralFigure> general_figures();

}  // namespace haff::campaign
