// SPDX-License-Identifier: GPL-3.0-or-later

// A plot's numbers as a table.
#pragma once

#include <filesystem>

#include "campaign/plot/plot.hpp"

namespace haff::campaign {

// CSV: a line of column names, then a row a point, reals with 17 digits, absent values empty. The
// column y_error is what bars and bands show: half the 68 % interval of the mean (averages.hpp);
// of a theory its standard error. Further parameters of curves and arrows add columns. Throws
// std::runtime_error if the file cannot be written.
void write_table(const Plot& plot, const std::filesystem::path& file);

}  // namespace haff::campaign
