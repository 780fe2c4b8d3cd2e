// One of the paper's figures: what it shows, what it needs, how it is made of averages.
//
// To add a figure: write figure_NN.cpp with its function, and its line in the table of
// figures.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "campaign/plot/colours.hpp"
#include "campaign/plot/plot.hpp"
#include "campaign/results/averages.hpp"

namespace haff::campaign {

// The density of the paper's base case [sigma^-d].
inline constexpr double base_density = 0.40;

// e of the paper's figures over densities.
inline constexpr double densities_restitution = 0.85;

// e of the paper's velocity correlations, and tau between which they scale.
inline constexpr double correlations_restitution = 0.80;
inline constexpr double scaling_from = 20, scaling_until = 60;

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

// tau up to which a figure of the homogeneous stage shows a series: somewhat beyond tau_c.
double homogeneous_stage(const MeanSeries& series);

// Only the points at x <= end.
Curve until(double end, Curve curve);

// A measured curve's name, gas, realizations and colour, without points.
Curve measured_curve(const MeanSeries& series);

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
