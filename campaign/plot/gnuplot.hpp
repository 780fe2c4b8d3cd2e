// SPDX-License-Identifier: GPL-3.0-or-later

// Running gnuplot on a script.
#pragma once

#include <stdexcept>
#include <string>

namespace haff::campaign {

// gnuplot is not installed. The message says how to install it.
struct GnuplotMissing : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Runs the script to its end and returns what it writes to its standard output: the picture, where
// the script sets no output. Throws GnuplotMissing, or std::runtime_error with gnuplot's own words
// if it fails. Warnings, about fonts for instance, are not errors.
std::string run_gnuplot(const std::string& script);

}  // namespace haff::campaign
