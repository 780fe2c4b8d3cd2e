// SPDX-License-Identifier: GPL-3.0-or-later

// A plot as a script for gnuplot.
#pragma once

#include <string>

#include "campaign/plot/plot.hpp"

namespace haff::campaign {

enum class PictureFormat { svg, png };

// The script writes the picture to gnuplot's standard output, so that no path is in it. The
// caption, which may hold text of the store, is data of the script: a line of it cannot become a
// command. Only a PNG has it in the picture; in an SVG its place is left empty.
std::string gnuplot_script(const Plot& plot, PictureFormat format);

// The part of the picture's height, from below, that is the caption's.
double caption_share(const Plot& plot);

}  // namespace haff::campaign
