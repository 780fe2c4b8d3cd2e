// SPDX-License-Identifier: GPL-3.0-or-later

// The paper's figures: each a plot made of averages.
//
// To add a figure: write figure_NN.cpp with its function, and its line in the table of
// figures.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "campaign/paper/base_case.hpp"
#include "campaign/paper/captions.hpp"
#include "campaign/paper/measured_curve.hpp"
#include "campaign/plot/colours.hpp"
#include "campaign/plot/plot.hpp"
#include "campaign/results/averages.hpp"

namespace haff::campaign {

// The curves of figure 10, G_parallel or G_perpendicular: G tau^(d/2) m / T_0 against r / (sigma
// sqrt(tau)) at each tau measured between scaling_from and scaling_until.
struct ScaledCorrelation {
  double tau;
  Curve curve;
};
std::vector<ScaledCorrelation> scaled_correlations(const MeanSeries& series,
                                                   const std::string& name);

// The plots; nothing if the averages lack their data.
std::optional<Plot> figure_01(const Averages& averages);
std::optional<Plot> figure_02(const Averages& averages);
std::optional<Plot> figure_03(const Averages& averages);
std::optional<Plot> figure_04(const Averages& averages);
std::optional<Plot> figure_05(const Averages& averages);
std::optional<Plot> figure_06(const Averages& averages);
std::optional<Plot> figure_07(const Averages& averages);
std::optional<Plot> figure_08(const Averages& averages);
std::optional<Plot> figure_09(const Averages& averages);
std::optional<Plot> figure_10(const Averages& averages);
std::optional<Plot> figure_11(const Averages& averages);
std::optional<Plot> figure_12(const Averages& averages);
std::optional<Plot> figure_13(const Averages& averages);
std::optional<Plot> figure_14(const Averages& averages);
std::optional<Plot> figure_15(const Averages& averages);

}  // namespace haff::campaign
