// `campaign figures`: the paper's figures from what the store holds.
//
// For each figure figure-01.csv (what is drawn, every sample), figure-01.svg and figure-01.png
// (drawn by gnuplot); unless single figures were asked for, also index.html, which shows all of
// them with their captions beside what is published, and agreement.csv, its table. Measured curves
// are means over realizations with their standard errors, of jobs that are done; theory curves come
// from the analysis room.
//
// Figures as in R. Kawahara and H. Nakanishi, cond-mat/0309130.
#pragma once

#include <filesystem>
#include <ostream>
#include <stdexcept>
#include <vector>

#include "schema/store.hpp"

namespace haff::campaign {

// A figure was asked for that the paper does not have. The message says which there are.
struct UnknownFigure : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

struct FigureRequest {
  std::filesystem::path out = "figures";  // made if it is not there
  std::vector<int> only = {};             // numbers of figures; empty: all
};

// Draws, and tells `report` of each figure: its files and caption, or what the store lacks and
// what to plan for it. A file that cannot be written or drawn, or comes out cut off, does not keep
// the others from it: the report says which are missing, and why. Returns an exit code:
//   0  every figure asked for is drawn; where none was named, at least one is
//   1  a figure that was named is not (the store lacks its data); or there is none to draw; or a
//      file is missing, because gnuplot is not installed, say
// Throws UnknownFigure (bad command line), std::runtime_error if the folder cannot be made, and the
// errors of the store.
int draw_figures(const schema::Reader& store, const FigureRequest& request, std::ostream& report);

}  // namespace haff::campaign
