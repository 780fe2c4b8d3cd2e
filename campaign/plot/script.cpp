// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/plot/script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "campaign/base/text/printable.hpp"
#include "campaign/plot/colours.hpp"

namespace haff::campaign {
namespace {

// More symbols than this on one curve run into each other.
constexpr std::size_t most_symbols = 40;

// A legend of more lines than this takes smaller type.
constexpr std::ptrdiff_t many_entries = 8;

// Of the picture, where the first panel's axes lie: left, right, bottom, top.
constexpr std::array<double, 4> full_frame = {0.15, 0.965, 0.215, 0.975};

// The caption: characters of a line that fit the picture in any font likely to be there, lines that
// have room below the axes, and their distance in fractions of a picture 480 high.
constexpr std::size_t caption_width = 90;  // of a picture 640 wide
constexpr std::size_t caption_lines = 2;
constexpr double caption_spacing = 0.031;

// gnuplot's single quotes: nothing is special but the quote itself.
std::string in_quotes(std::string_view text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

// Blanks at which a line must not be broken: around "=", within a number, and before "%".
std::string bound(std::string_view text) {
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char before = i > 0 ? text[i - 1] : ' ';
    const char after = i + 1 < text.size() ? text[i + 1] : ' ';
    const bool keep =
        before == '=' || after == '=' || (digit(before) && (digit(after) || after == '%'));
    result += text[i] == ' ' && keep ? std::string("\u00a0") : std::string(1, text[i]);
  }
  return result;
}

// Lines of at most this many characters, broken at blanks.
std::vector<std::string> wrapped(std::string_view text, std::size_t width) {
  const auto length = [](std::string_view utf8) {
    return static_cast<std::size_t>(
        std::ranges::count_if(utf8, [](char c) { return (c & 0xc0) != 0x80; }));
  };
  std::vector<std::string> lines(1);
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(word.size() + 1, text.size()));
    if (lines.back().empty()) {
      lines.back() = word;
    } else if (length(lines.back()) + 1 + length(word) <= width) {
      lines.back().append(" ").append(word);
    } else {
      lines.emplace_back(word);
    }
  }
  return lines;
}

bool drawable(double x, const Axis& axis) {
  return std::isfinite(x) && (!axis.logarithmic || x > 0);
}

// The points of a curve that the picture shows.
std::vector<std::size_t> shown_points(const Curve& curve, const Panel& panel) {
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    if (drawable(curve.x[i], panel.x) && drawable(curve.y[i], panel.y)) shown.push_back(i);
  }
  if (curve.look != Look::symbols || shown.size() <= most_symbols) return shown;
  const std::size_t stride = (shown.size() + most_symbols - 1) / most_symbols;
  std::vector<std::size_t> thinned;
  for (std::size_t i = 0; i < shown.size(); i += stride) thinned.push_back(shown[i]);
  return thinned;
}

// A frame of a row of panels leaves the caption its room, as the first panel's does; an inset lies
// above it anyway.
std::array<double, 4> above_caption(std::array<double, 4> frame, double axes_bottom) {
  frame[2] = std::max(frame[2], axes_bottom);
  return frame;
}

// With room for what stands right of the axes.
std::array<double, 4> frame_beside(const Panel& panel, std::array<double, 4> frame) {
  frame[0] *= panel.axes_share;
  frame[1] *= panel.axes_share;
  return frame;
}

std::string key_place(const Panel& panel, const std::array<double, 4>& frame) {
  if (panel.legend != "beside") return panel.legend;
  const double scale = panel.scale ? 0.1 : 0;  // which stands between
  return fmt::format("at screen {}, screen {} left top", frame[1] + 0.01 + scale, frame[3]);
}

// Rows x, y, dx, dy, length: an arrow with its middle at the point.
std::string arrow_block(const Curve& curve, const Panel& panel, const std::string& name,
                        const std::vector<std::size_t>& points) {
  std::string block = name + " << END\n";
  for (const std::size_t i : points) {
    const auto [u, v] = curve.arrow[i];
    if (!std::isfinite(u) || !std::isfinite(v)) continue;
    const double dx = u * panel.arrow_scale, dy = v * panel.arrow_scale;
    block += fmt::format("{:.8g} {:.8g} {:.8g} {:.8g} {:.8g}\n", curve.x[i] - dx / 2,
                         curve.y[i] - dy / 2, dx, dy, std::hypot(u, v));
  }
  return block + "END\n";
}

// Rows x, y, y - error, y + error.
std::string data_block(const Curve& curve, const Panel& panel, const std::string& name,
                       const std::vector<std::size_t>& points) {
  std::string block = name + " << END\n";
  for (const std::size_t i : points) {
    const double y = curve.y[i];
    const double error = std::isfinite(curve.error_at(i)) ? curve.error_at(i) : 0;
    // A logarithmic axis cannot show where an error bar reaches below zero: it leaves the picture.
    const double below = panel.y.logarithmic ? std::max(y - error, 1e-3 * y) : y - error;
    block += fmt::format("{:.8g} {:.8g} {:.8g} {:.8g}\n", curve.x[i], y, below, y + error);
  }
  return block + "END\n";
}

bool has_errors(const Curve& curve) {
  return std::ranges::any_of(curve.error, [](double e) { return e > 0; });
}

std::string dashes(Look look) {
  switch (look) {
    case Look::dashed:
      return "dt (9,5)";
    case Look::dotted:
      return "dt (2,4)";
    case Look::dash_dotted:
      return "dt (9,4,2,4)";
    default:
      return "dt solid";
  }
}

std::string plot_element(const Curve& curve, const std::string& block) {
  const std::string title = curve.legend.empty() ? "notitle" : "title " + in_quotes(curve.legend);
  const std::string ink = fmt::format("lc rgb '{}'", curve.colour);
  const std::string style =
      curve.look == Look::symbols
          ? fmt::format("{} pt {} ps {} lw {} {}", curve.joined ? "linespoints" : "points",
                        curve.symbol, curve.size, curve.joined ? 0.8 : 1.2, ink)
          : fmt::format("lines lw {} {} {}", curve.width, dashes(curve.look), ink);
  if (block.empty()) return fmt::format("keyentry with {} {}", style, title);
  if (curve.look == Look::arrows) {
    return fmt::format(
        "{} using 1:2:3:4:5 with vectors head size 0.9,22,60 filled lw {} lc palette "
        "notitle",
        block, curve.width);
  }

  std::string errors;
  if (has_errors(curve) && curve.look == Look::symbols) {
    errors =
        fmt::format("{} using 1:3:(0):($4-$3) with vectors nohead lw 1.2 {} notitle, ", block, ink);
  } else if (has_errors(curve)) {
    errors = fmt::format(
        "{} using 1:3:4 with filledcurves fc rgb '{}' fs transparent solid 0.25 noborder "
        "notitle, ",
        block, curve.colour);
  }
  return fmt::format("{}{} using 1:2 with {} {}", errors, block, style, title);
}

std::ptrdiff_t entries(const Panel& panel) {
  return std::ranges::count_if(panel.curves, [](const Curve& c) { return !c.legend.empty(); });
}

// "0 '#440154', 1 '#46327E', ..." from one end of viridis to the other.
std::string palette(bool dark_first) {
  constexpr std::size_t steps = 7;
  std::string stops;
  for (std::size_t i = 0; i < steps; ++i)
    stops += fmt::format("{}{} '{}'", i == 0 ? "" : ", ", i,
                         shade(dark_first ? i : steps - 1 - i, steps));
  return fmt::format("set palette defined ({})\n", stops);
}

// Right of the axes.
std::string colour_box(const std::array<double, 4>& frame, const std::string& label) {
  return fmt::format(
      "set colorbox user origin screen {}, screen {} size screen 0.012, screen {}\n"
      "set cblabel {} offset character 1, 0\n",
      frame[1] + 0.012, frame[2], frame[3] - frame[2], in_quotes(label));
}

// Tones of arrows, dark for the fast.
std::string tone_commands(const Panel& panel, const std::array<double, 4>& frame) {
  return palette(false) +
         fmt::format("set cbrange [0:{:.8g}]\nset cbtics {:g}\n", panel.tone_high,
                     round_step(panel.tone_high / 5)) +
         (panel.tone_label.empty() ? "unset colorbox\n" : colour_box(frame, panel.tone_label));
}

// Tones of curves in place of a legend.
std::string scale_commands(const ToneScale& scale, const std::array<double, 4>& frame) {
  return palette(true) +
         fmt::format("{} logscale cb\nset cbrange [{:.8g}:{:.8g}]\nset cbtics auto\n",
                     scale.logarithmic ? "set" : "unset", scale.low, scale.high) +
         colour_box(frame, scale.label);
}

// Whether tics read as powers of ten: beside "1e-05", "0.0001" is of another kind. Over fewer
// decades tics stand between the powers, too.
bool spans_powers(const Axis& axis) {
  if (!axis.logarithmic || !axis.low || !axis.high) return false;
  constexpr double many_decades = 1e3, smallest = 1e-4, largest = 1e5;
  return *axis.high > many_decades * *axis.low && (*axis.low < smallest || *axis.high > largest);
}

std::string axis_commands(const Axis& axis, char letter) {
  const auto bound = [](const std::optional<double>& value) {
    return value ? fmt::format("{:.8g}", *value) : std::string("*");
  };
  std::string text = fmt::format("set {}label {}\n", letter, in_quotes(axis.label));
  text += fmt::format("{} logscale {}\n", axis.logarithmic ? "set" : "unset", letter);
  text += fmt::format("set {}range [{}:{}]\n", letter, bound(axis.low), bound(axis.high));
  text += fmt::format("set format {} '{}'\n", letter,
                      spans_powers(axis) ? "10^{%T}" : "%g");  // tics may name another
  text += fmt::format("set {}tics {}\n", letter, axis.tics.empty() ? "autofreq" : axis.tics);
  text += fmt::format("set m{}tics {}\n", letter, axis.logarithmic ? "10" : "2");
  return text;
}

// The caption's lines and the height of the uppermost one, in fractions of the picture.
struct Caption {
  std::vector<std::string> lines;
  double spare = 0;  // lines beyond those that have room below the axes
  double spacing = 0, top = 0;
};

Caption laid_out(const Plot& plot) {
  Caption caption;
  const std::size_t width = caption_width * static_cast<std::size_t>(plot.width) / 640;
  caption.lines = wrapped(bound(printable(plot.caption)), width);
  caption.spare =
      static_cast<double>(std::max(caption.lines.size(), caption_lines) - caption_lines);
  caption.spacing = caption_spacing * 480.0 / plot.height;
  caption.top = 0.07 * 480.0 / plot.height + caption.spare * caption.spacing;
  return caption;
}

// A line of data that gnuplot shows as it is: it would otherwise read \n as the end of a line.
std::string as_data(std::string_view line) {
  std::string data;
  for (const char c : line) data += c == '\\' ? std::string("\\\\") : std::string(1, c);
  return data;
}

// A data block of the lines with their places, and the plot that writes them.
std::string caption_commands(const Caption& caption) {
  std::string block = "$caption << END\n";
  double height = caption.top;
  for (const std::string& line : caption.lines) {
    block += fmt::format("{}\t{}\t{}\n", 0.02, height, as_data(line));
    height -= caption.spacing;
  }
  return block +
         "END\n"
         "set lmargin at screen 0\nset rmargin at screen 1\n"
         "set bmargin at screen 0\nset tmargin at screen 1\n"
         "unset border\nunset tics\nunset key\nset xrange [0:1]\nset yrange [0:1]\n"
         "set datafile separator \"\\t\"\n"
         "plot $caption using 1:2:3 with labels left noenhanced font ',9.5' tc rgb '#555555'\n"
         "set datafile separator whitespace\n";
}

}  // namespace

double caption_share(const Plot& plot) {
  constexpr double half_a_line = 0.02;  // above the middle of the uppermost one
  return laid_out(plot).top + half_a_line * 480.0 / plot.height;
}

std::string gnuplot_script(const Plot& plot, PictureFormat format) {
  const Caption caption = laid_out(plot);
  auto first_frame = full_frame;
  first_frame[2] += caption.spare * caption.spacing;
  std::string blocks, panels;
  int count = 0;
  for (const Panel& panel : plot.panels) {
    const auto frame = !panel.frame  ? frame_beside(panel, first_frame)
                       : panel.small ? *panel.frame
                                     : above_caption(*panel.frame, first_frame[2]);
    panels += fmt::format(
        "set lmargin at screen {}\nset rmargin at screen {}\n"
        "set bmargin at screen {}\nset tmargin at screen {}\n",
        frame[0], frame[1], frame[2], frame[3]);
    panels += panel.legend == "none"
                  ? "unset key\n"
                  : fmt::format("set key {} Left reverse samplen 2.2 {}\n", key_place(panel, frame),
                                entries(panel) > many_entries ? "font ',9' spacing 0.95"
                                                              : "font ',12' spacing 1.15");
    panels += fmt::format("set tics font ',{}'\n", panel.small ? 10 : 12);
    panels += axis_commands(panel.x, 'x') + axis_commands(panel.y, 'y');
    if (has_arrows(panel)) panels += tone_commands(panel, frame);
    if (panel.scale) panels += scale_commands(*panel.scale, frame);
    for (const std::string& command : panel.commands) panels += command + "\n";
    std::string elements;
    for (const Curve& curve : panel.curves) {
      // gnuplot refuses to plot nothing.
      const auto points = shown_points(curve, panel);
      const std::string block = points.empty() ? "" : fmt::format("$curve{}", count++);
      if (!points.empty()) {
        blocks += curve.arrow.empty() ? data_block(curve, panel, block, points)
                                      : arrow_block(curve, panel, block, points);
      }
      elements += (elements.empty() ? "" : ", ") + plot_element(curve, block);
    }
    // gnuplot draws the scale for a plot that uses its palette.
    if (panel.scale) elements += ", 1/0 with points palette notitle";
    panels += "plot " + elements + "\nunset colorbox\nunset label\nunset arrow\nunset object\n";
  }

  // Arial is what viewers of SVG have or replace by its like (Liberation Sans on Debian).
  const std::string terminal =
      format == PictureFormat::svg
          ? fmt::format("svg size {},{} enhanced font 'Arial,12' fontscale 1.3 background 'white'",
                        plot.width, plot.height)
          : fmt::format(
                "pngcairo size {},{} enhanced font 'Arial,12' fontscale 2 linewidth 2 "
                "pointscale 2",
                2 * plot.width, 2 * plot.height);
  return "set encoding utf8\nset terminal " + terminal + "\n" + blocks + "set multiplot\n" +
         (format == PictureFormat::png ? caption_commands(caption) : "") +
         "set border 15 lw 1\nset tics in scale 0.8,0.4\nset format '%g'\nset minussign\n" +
         panels + "unset multiplot\n";
}

}  // namespace haff::campaign
