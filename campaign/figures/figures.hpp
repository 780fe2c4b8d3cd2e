// SPDX-License-Identifier: GPL-3.0-or-later

// `campaign figures`: what a store has, as pictures and one page.
//
// The paper's figures where the store has its gases, figure-01 ..., beside what is published; and
// figures of whatever gases the store has, gas-energy ... (general.hpp). Of each .csv (what is
// drawn, every sample), .svg and .png (drawn by gnuplot); unless single figures were asked for,
// also index.html, which shows all of them with their captions, and agreement.csv, the table of
// what the paper claims. Measured curves are means over realizations, of jobs that are done, with
// the errors of results/averages.hpp; theory curves come from the analysis room.
#pragma once

#include <filesystem>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "schema/store/store.hpp"

namespace haff::campaign {

// A figure was asked for that there is not. The message says which there are.
struct UnknownFigure : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

struct FigureRequest {
  std::filesystem::path out = "figures";  // made if it is not there
  std::vector<int> only = {};             // numbers of the paper's figures; both empty: all
  std::vector<std::string> gases = {};    // names of general figures
};

// Draws, and tells `report` of each figure: its files and caption, or what the store lacks and
// what to plan for it. A file that cannot be written or drawn, or comes out cut off, does not keep
// the others from it: the report says which are missing, and why. Pictures of an earlier run that
// this store does not make stay in the folder and are named, on the page too. Returns an exit code:
//   0  every figure asked for is drawn; where none was named, at least one is
//   1  a figure that was named is not (the store lacks its data); or there is none to draw; or a
//      file is missing, because gnuplot is not installed, say
// Throws UnknownFigure (bad command line), std::runtime_error if the folder cannot be made, and the
// errors of the store.
int draw_figures(const schema::Reader& store, const FigureRequest& request, std::ostream& report);

}  // namespace haff::campaign
