// SPDX-License-Identifier: GPL-3.0-or-later

// The frame of a picture: the ranges of its axes, and where its legend stands.
#pragma once

#include <cstddef>

#include "campaign/plot/plot.hpp"

namespace haff::campaign {

// Throws NothingToDraw if an axis is logarithmic and no value on it is above 0.
void check_logarithmic(const Panel& panel);

// Axes that show what was measured, and of theory what is near. The first `gases` curves are
// measured.
void set_ranges(Panel& panel, std::size_t gases);

// Legend or scale stand beside the axes, where they hide no curve. Returns the picture's width.
int place_legend(Panel& panel);

}  // namespace haff::campaign
