// SPDX-License-Identifier: GPL-3.0-or-later

// Measured curves as figures draw them.
#pragma once

#include "campaign/plot/plot.hpp"
#include "campaign/results/averages.hpp"

namespace haff::campaign {

// tau up to which a figure of the homogeneous stage shows a series: somewhat beyond tau_c, and no
// further than half of its realizations go.
double homogeneous_stage(const MeanSeries& series);

// Only the points at x <= end.
Curve until(double end, Curve curve);

// A measured curve's name, gas, realizations and colour, without points.
Curve measured_curve(const MeanSeries& series);

}  // namespace haff::campaign
