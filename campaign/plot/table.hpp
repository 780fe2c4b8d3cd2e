// A plot's numbers as a table.
#pragma once

#include <filesystem>

#include "campaign/plot/plot.hpp"

namespace haff::campaign {

// CSV: a line of column names, then a row a point, reals with 17 digits, absent values empty.
// Arrows add two columns. Throws std::runtime_error if the file cannot be written.
void write_table(const Plot& plot, const std::filesystem::path& file);

}  // namespace haff::campaign
