// SPDX-License-Identifier: GPL-3.0-or-later

// The paper's figures by their numbers: R. Kawahara and H. Nakanishi, cond-mat/0309130, and some
// that are not drawn there but argued with.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "campaign/plot/plot.hpp"
#include "campaign/results/averages.hpp"

namespace haff::campaign {

struct PaperFigure {
  int id;
  std::string_view title;
  std::optional<Plot> (*make)(const Averages&);  // nothing if the averages lack its data
  std::string_view plan;                         // a grid that gives its data
  std::string_view published;                    // what the paper shows there
};

std::span<const PaperFigure> paper_figures();

}  // namespace haff::campaign
