// SPDX-License-Identifier: GPL-3.0-or-later

// Drawing a plot as a picture.
#pragma once

#include <filesystem>

#include "campaign/base/output/output_files.hpp"
#include "campaign/plot/plot.hpp"
#include "campaign/plot/script.hpp"

namespace haff::campaign {

// Draws the picture and writes it to the file. Throws GnuplotMissing; std::runtime_error if gnuplot
// fails, if what it has drawn is not a whole picture, or if the file cannot be written. After an
// error there is no such file.
void draw_picture(const Plot& plot, const std::filesystem::path& file, PictureFormat format);

// stem.svg and stem.png.
void draw_both(const Plot& plot, const std::filesystem::path& stem, OutputFiles& files);

}  // namespace haff::campaign
