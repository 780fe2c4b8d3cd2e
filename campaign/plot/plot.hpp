// SPDX-License-Identifier: GPL-3.0-or-later

// A plot: curves in panels, written as a table (CSV) and as a script for gnuplot.
//
// The table holds every point; the picture thins symbols so that they can be told apart.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace haff::campaign {

enum class Look { symbols, line, dashed, dotted, dash_dotted, arrows };

// Where a curve comes from, in the table's column `kind`.
enum class Source { measured, theory, published };

struct Curve {
  std::string name = {};    // in the table's column `curve`
  std::string legend = {};  // gnuplot's enhanced text; empty: not in the legend
  Source source = Source::measured;

  // What it is of, for the table; empty where it is of none in particular.
  std::optional<double> e = {}, n = {};
  std::optional<std::int64_t> particles = {};
  std::vector<std::pair<std::string, std::string>> parameters = {};  // further ones, by name

  std::vector<double> x = {}, y = {};
  std::vector<double> error = {};                 // what is drawn of y's, NaN or empty: none
  std::vector<std::int64_t> realizations = {};    // averaged at each point; empty for theory
  std::vector<std::array<double, 2>> arrow = {};  // at each point, for Look::arrows

  // In the picture. A curve without points is an entry of the legend only.
  Look look = Look::line;
  std::string colour = "#000000";
  bool joined = false;  // symbols with a thin line from one to the next
  int symbol = 7;       // gnuplot's point type
  double size = 0.55;   // of symbols, in gnuplot's unit
  double width = 1.8;   // of lines [pt]

  double error_at(std::size_t i) const;  // NaN: none
};

// Errors are drawn as bars on symbols and as a band behind lines.

struct Axis {
  std::string label = {};   // enhanced text
  std::string column = {};  // its name in the table
  bool logarithmic = false;
  std::optional<double> low = {}, high = {};
  std::string tics = {};  // further gnuplot words for tics, e.g. "10"
};

// Tones in place of a legend, for many curves that have an order: those of shade(), from dark at
// `low` to light at `high`.
struct ToneScale {
  std::string label = {};  // enhanced text
  double low = 0, high = 1;
  bool logarithmic = false;

  std::string tone(double value) const;  // a colour
};

struct Panel {
  std::string name = "main";  // in the table's column `panel`
  Axis x, y;
  std::vector<Curve> curves = {};
  std::string legend = "top right";  // its place, gnuplot's words; "none" for none; "beside"
                                     // for right of the axes
  // The part of the picture's width, from the left, that the axes have with what belongs to them:
  // less than 1 where a scale or a legend stands beside.
  double axes_share = 1;
  std::vector<std::string> commands = {};  // of gnuplot, for what is no curve: labels, arrows
  bool small = false;                      // smaller type, for an inset
  // Of arrows: length on the axes of an arrow of length 1, the length whose tone is the brightest,
  // and what the scale of tones is labelled; empty for no scale.
  double arrow_scale = 1, tone_high = 1;
  std::string tone_label = {};
  std::optional<ToneScale> scale = {};  // of the curves' colours
  // Left, right, bottom, top of the axes as fractions of the picture, for an inset or a row.
  std::optional<std::array<double, 4>> frame = {};
};

bool has_arrows(const Panel& panel);

struct Plot {
  std::vector<Panel> panels;  // one without a frame fills the picture; same columns
  std::string caption = {};   // plain text
  int width = 640;            // of the picture [pixels]
  int height = 480;
};

// Least and largest y of what these curves draw, error bars included; {0, 1} if there is nothing.
struct Range {
  double low, high;
  double width() const { return high - low; }
};
Range y_range(const std::vector<Curve>& curves, bool logarithmic = false);

// The power of ten that leaves some room below a value: where a logarithmic axis ends.
double decade_below(double value);

// The nearest of 1, 2, 5, 10 times a power of ten from above: a distance between tics.
double round_step(double at_least);

}  // namespace haff::campaign
