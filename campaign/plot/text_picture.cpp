// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/plot/text_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "campaign/base/text/printable.hpp"

namespace haff::campaign {
namespace {

constexpr int dots_across = 2, dots_down = 4;  // of a character

// The least area of curves that shows anything.
constexpr int fewest_columns = 10, fewest_lines = 4;

// Characters of UTF-8 text, all of them one column wide.
int width_of(std::string_view text) {
  return static_cast<int>(std::ranges::count_if(text, [](char c) { return (c & 0xc0) != 0x80; }));
}

std::string blanks(int count) {
  return std::string(static_cast<std::size_t>(std::max(0, count)), ' ');
}

// The first characters, this many.
std::string cut(const std::string& text, int width) {
  std::size_t end = 0;
  for (int k = 0; end < text.size() && k < width; ++k) do
      ++end;
    while (end < text.size() && (text[end] & 0xc0) == 0x80);
  return text.substr(0, end);
}

std::string utf8(std::uint32_t code) {
  return {static_cast<char>(0xe0 | (code >> 12)), static_cast<char>(0x80 | ((code >> 6) & 0x3f)),
          static_cast<char>(0x80 | (code & 0x3f))};
}

// The nearest of xterm's 6 x 6 x 6 colours.
int xterm_colour(const std::string& rgb) {
  const auto part = [&](std::size_t at) { return std::stoi(rgb.substr(at, 2), nullptr, 16); };
  const auto level = [](int value) { return value < 48 ? 0 : value < 115 ? 1 : (value - 35) / 40; };
  return 16 + 36 * level(part(1)) + 6 * level(part(3)) + level(part(5));
}

// ---- axes -------------------------------------------------------------------------------------

// An axis whose ends are known.
struct Ends {
  double low = 0, high = 1;
  bool logarithmic = false;

  // 0 at the low end, 1 at the high one.
  double share(double value) const {
    if (logarithmic) return std::log(value / low) / std::log(high / low);
    return (value - low) / (high - low);
  }
};

Ends ends_of(const Axis& axis, double least, double most) {
  Ends ends{.low = axis.low.value_or(least),
            .high = axis.high.value_or(most),
            .logarithmic = axis.logarithmic};
  if (!(ends.low < ends.high)) {
    ends.low = ends.logarithmic ? ends.low / 2 : ends.low - 1;
    ends.high = ends.logarithmic ? ends.low * 4 : ends.low + 2;
  }
  return ends;
}

std::vector<double> tics_of(const Ends& ends, int at_most) {
  std::vector<double> tics;
  if (ends.logarithmic && ends.high / ends.low > 10) {
    const double decades = std::log10(ends.high / ends.low);
    const int step = std::max(1, static_cast<int>(std::ceil(decades / at_most)));
    for (int k = static_cast<int>(std::ceil(std::log10(ends.low) - 1e-9));
         std::pow(10, k) <= ends.high * (1 + 1e-9); ++k)
      if (k % step == 0) tics.push_back(std::pow(10, k));
    return tics;
  }
  const double step = round_step((ends.high - ends.low) / at_most);
  for (double k = std::ceil(ends.low / step - 1e-9); k * step <= ends.high + 1e-9 * step; ++k)
    tics.push_back(k == 0 ? 0 : k * step);
  return tics;
}

// ---- the area of curves -----------------------------------------------------------------------

class Canvas {
 public:
  Canvas(int columns, int lines)
      : columns_(columns), lines_(lines), cells_(static_cast<std::size_t>(columns * lines)) {}

  int dots_wide() const { return columns_ * dots_across; }
  int dots_high() const { return lines_ * dots_down; }

  void dot(int x, int y, int colour) {  // from the lower left
    if (x < 0 || y < 0 || x >= dots_wide() || y >= dots_high()) return;
    const int down = dots_high() - 1 - y;
    // Bits of a character's dots, by column and line of it.
    constexpr std::array<std::array<unsigned, 4>, 2> bits{
        {{0x01, 0x02, 0x04, 0x40}, {0x08, 0x10, 0x20, 0x80}}};
    Cell& cell = at(x / dots_across, down / dots_down);
    cell.dots |=
        bits[static_cast<std::size_t>(x % dots_across)][static_cast<std::size_t>(down % dots_down)];
    cell.colour = colour;
  }

  // In place of the dots there.
  void mark(int x, int y, const std::string& character, int colour) {
    if (x < 0 || y < 0 || x >= dots_wide() || y >= dots_high()) return;
    Cell& cell = at(x / dots_across, (dots_high() - 1 - y) / dots_down);
    cell.mark = character;
    cell.colour = colour;
  }

  std::string line(int k, bool in_colour) const {
    std::string text;
    int before = -1;
    for (int c = 0; c < columns_; ++c) {
      const Cell& cell = cells_[place(c, k)];
      const bool is_empty = cell.dots == 0 && cell.mark.empty();
      const int colour = is_empty ? -1 : cell.colour;
      if (in_colour && colour != before)
        text += colour < 0 ? std::string("\x1b[0m") : fmt::format("\x1b[38;5;{}m", colour);
      before = colour;
      text += !cell.mark.empty() ? cell.mark
              : cell.dots == 0   ? std::string(" ")
                                 : utf8(0x2800 + cell.dots);
    }
    if (in_colour && before >= 0) text += "\x1b[0m";
    return text;
  }

 private:
  struct Cell {
    unsigned dots = 0;
    int colour = -1;
    std::string mark = {};
  };
  std::size_t place(int column, int line) const {
    return static_cast<std::size_t>(line) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  Cell& at(int column, int line) { return cells_[place(column, line)]; }

  int columns_, lines_;
  std::vector<Cell> cells_;
};

struct Place {
  double x, y;  // dots
};

class Painter {
 public:
  Painter(Canvas& canvas, const Ends& x, const Ends& y, bool has_bars)
      : canvas_(canvas), x_(x), y_(y), has_bars_(has_bars) {}

  void paint(const Curve& curve, const std::string& letter, int colour) const {
    const bool is_line = curve.look != Look::symbols;
    Place before{};
    bool follows = false;  // on a point that is drawn
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
      if (!drawable(curve.x[i], x_) || !drawable(curve.y[i], y_)) {
        follows = false;
        continue;
      }
      const Place here = place(curve.x[i], curve.y[i]);
      if (follows && (is_line || curve.joined)) line(before, here, curve.look, colour);
      before = here;
      follows = true;
    }
    if (!is_line) symbols(curve, letter, colour);
    if (is_line && !letter.empty()) letters(curve, letter, colour);
  }

 private:
  static bool drawable(double value, const Ends& ends) {
    return std::isfinite(value) && (!ends.logarithmic || value > 0);
  }

  Place place(double x, double y) const {
    return {x_.share(x) * (canvas_.dots_wide() - 1), y_.share(y) * (canvas_.dots_high() - 1)};
  }

  void line(const Place& from, const Place& to, Look look, int colour) const {
    // Only the part near the picture: a curve may run far beyond it.
    const double most = 4.0 * (canvas_.dots_wide() + canvas_.dots_high());
    const double length = std::max({std::abs(to.x - from.x), std::abs(to.y - from.y), 1.0});
    if (!(length < most * 100)) return;
    const int count = static_cast<int>(std::ceil(length));
    for (int k = 0; k <= count; ++k) {
      const int x = static_cast<int>(std::lround(from.x + (to.x - from.x) * k / count));
      const int y = static_cast<int>(std::lround(from.y + (to.y - from.y) * k / count));
      if (is_gap(look, x)) continue;
      canvas_.dot(x, y, colour);
    }
  }

  // Dashes are told by x alone, so that short steps make the pattern, too.
  static bool is_gap(Look look, int x) {
    if (look == Look::dashed) return x % 6 >= 4;
    if (look == Look::dotted) return x % 4 >= 1;
    if (look == Look::dash_dotted) return x % 8 == 4 || x % 8 >= 6;
    return false;
  }

  void symbols(const Curve& curve, const std::string& letter, int colour) const {
    const std::size_t room = static_cast<std::size_t>(std::max(1, canvas_.dots_wide() / 6));
    const std::size_t stride = (curve.x.size() + room - 1) / room;
    for (std::size_t i = 0; i < curve.x.size(); i += stride) {
      if (!drawable(curve.x[i], x_) || !drawable(curve.y[i], y_)) continue;
      const Place here = place(curve.x[i], curve.y[i]);
      const double error = curve.error_at(i);
      if (error > 0 && has_bars_ && !y_.logarithmic) {
        const Place top = place(curve.x[i], curve.y[i] + error);
        const Place bottom = place(curve.x[i], curve.y[i] - error);
        line(bottom, top, Look::line, colour);
      }
      canvas_.mark(static_cast<int>(std::lround(here.x)), static_cast<int>(std::lround(here.y)),
                   letter.empty() ? "●" : letter, colour);
    }
  }

  // The curve's letter here and there on it.
  void letters(const Curve& curve, const std::string& letter, int colour) const {
    constexpr std::size_t count = 3;
    for (std::size_t k = 1; k <= count; ++k) {
      const std::size_t i = curve.x.size() * (2 * k - 1) / (2 * count);
      if (i >= curve.x.size() || !drawable(curve.x[i], x_) || !drawable(curve.y[i], y_)) continue;
      const Place here = place(curve.x[i], curve.y[i]);
      canvas_.mark(static_cast<int>(std::lround(here.x)), static_cast<int>(std::lround(here.y)),
                   letter, colour);
    }
  }

  Canvas& canvas_;
  const Ends &x_, &y_;
  bool has_bars_;
};

// ---- what stands around it --------------------------------------------------------------------

std::string coloured(const std::string& text, int colour, bool in_colour) {
  return in_colour ? fmt::format("\x1b[38;5;{}m{}\x1b[0m", colour, text) : text;
}

std::string sample(const Curve& curve) {
  if (curve.look == Look::symbols) return "●";
  if (curve.look == Look::dashed) return "╌╌";
  if (curve.look == Look::dotted) return "┈┈";
  if (curve.look == Look::dash_dotted) return "─·";
  return "──";
}

struct Entry {
  std::string text;
  int width;
};

// Entries one after another, in lines of at most this width.
std::string wrapped(const std::vector<Entry>& entries, int margin, int width) {
  std::string text;
  int used = 0;
  for (const Entry& entry : entries) {
    if (used > 0 && used + 3 + entry.width > width) {
      text += '\n';
      used = 0;
    }
    text += used == 0 ? blanks(margin) : std::string("   ");
    used += entry.width + (used == 0 ? margin : 3);
    text += entry.text;
  }
  return used > 0 ? text + '\n' : text;
}

std::string scale_line(const ToneScale& scale, int margin, int width, bool in_colour) {
  const int cells = std::clamp(width - margin - 40, 5, 30);
  std::string text =
      blanks(margin) + without_markup(scale.label) + fmt::format(": {:g} ", scale.low);
  for (int k = 0; k < cells; ++k) {
    const double share = (k + 0.5) / cells;
    const double value = scale.logarithmic ? scale.low * std::pow(scale.high / scale.low, share)
                                           : scale.low + share * (scale.high - scale.low);
    text += in_colour ? coloured("█", xterm_colour(scale.tone(value)), true)
                      : std::string(k % 2 == 0 ? "░" : "▒");
  }
  return text + fmt::format(" {:g}\n", scale.high);
}

// A letter for each curve that is measured, where there are few enough: a ... z.
std::string letter_of(std::size_t k) {
  return k < 26 ? std::string(1, static_cast<char>('a' + k)) : std::string();
}

}  // namespace

std::string without_markup(std::string_view enhanced) {
  std::string text;
  for (std::size_t i = 0; i < enhanced.size(); ++i) {
    if (enhanced[i] == '\\' && i + 1 < enhanced.size()) {
      text += enhanced[++i];
    } else if (enhanced[i] == '{') {
      // "{/:Italic " or "{/:Bold ": the style ends at the blank.
      if (enhanced.substr(i).starts_with("{/"))
        i = std::min(enhanced.find(' ', i), enhanced.size());
    } else if (enhanced[i] != '}') {
      text += enhanced[i];
    }
  }
  return printable(text);
}

std::string text_picture(const Plot& plot, const TextSize& size, bool in_colour) {
  const Panel& panel = plot.panels.front();
  std::vector<double> xs;
  for (const Curve& curve : panel.curves)
    for (const double x : curve.x)
      if (std::isfinite(x) && (!panel.x.logarithmic || x > 0)) xs.push_back(x);
  const Range range = y_range(panel.curves, panel.y.logarithmic);
  const Ends x = xs.empty() ? Ends{} : ends_of(panel.x, std::ranges::min(xs), std::ranges::max(xs));
  const Ends y = ends_of(panel.y, range.low, range.high);

  constexpr int lines_around = 4;  // label above, axis, numbers, label below
  const int lines = std::max(fewest_lines, size.lines - lines_around);
  const auto y_tics = tics_of(y, std::max(3, lines / 3));
  int margin = 4;
  for (const double tic : y_tics) margin = std::max(margin, width_of(fmt::format("{:g}", tic)) + 2);
  const int columns = std::max(fewest_columns, size.columns - margin - 1);

  Canvas canvas(columns, lines);
  // Error bars of more curves run into each other.
  constexpr std::ptrdiff_t most_with_bars = 2;
  const auto symbols = std::ranges::count(panel.curves, Look::symbols, &Curve::look);
  const Painter painter(canvas, x, y, symbols <= most_with_bars);
  std::vector<Entry> entries;
  std::size_t measured = 0;
  for (const Curve& curve : panel.curves) {
    const bool is_measured = curve.source != Source::theory && !curve.x.empty();
    const std::string letter = in_colour || !is_measured || panel.scale ? "" : letter_of(measured);
    measured += is_measured ? 1 : 0;
    const int colour = xterm_colour(curve.colour);
    painter.paint(curve, letter, colour);
    if (curve.legend.empty()) continue;
    const std::string key = letter.empty() ? sample(curve) : letter;
    const std::string words = cut(without_markup(curve.legend), size.columns - margin - 4);
    entries.push_back(
        {coloured(key, colour, in_colour) + " " + words, width_of(key) + 1 + width_of(words)});
  }

  std::string text = cut(without_markup(panel.y.label), size.columns) + "\n";
  std::vector<std::string> numbers(static_cast<std::size_t>(lines));
  for (const double tic : y_tics) {
    const int line = lines - 1 - static_cast<int>(std::lround(y.share(tic) * (lines - 1)));
    numbers[static_cast<std::size_t>(std::clamp(line, 0, lines - 1))] = fmt::format("{:g}", tic);
  }
  for (int k = 0; k < lines; ++k) {
    const std::string& number = numbers[static_cast<std::size_t>(k)];
    text += blanks(margin - 1 - width_of(number)) + number + (number.empty() ? "│" : "┤") +
            canvas.line(k, in_colour) + "\n";
  }
  std::string axis, under;
  for (int c = 0; c < columns; ++c) axis += "─";
  under = blanks(columns + margin);
  const auto x_tics = tics_of(x, std::max(2, columns / 12));
  std::vector<std::string> line(static_cast<std::size_t>(columns), "─");
  int free_from = 0;
  for (const double tic : x_tics) {
    const int column =
        std::clamp(static_cast<int>(std::lround(x.share(tic) * (columns - 1))), 0, columns - 1);
    line[static_cast<std::size_t>(column)] = "┬";
    const std::string number = fmt::format("{:g}", tic);
    const int from =
        std::clamp(margin + column - width_of(number) / 2, 0, margin + columns - width_of(number));
    if (from < free_from) continue;
    under.replace(static_cast<std::size_t>(from), number.size(), number);
    free_from = from + width_of(number) + 1;
  }
  axis.clear();
  for (const std::string& each : line) axis += each;
  text += blanks(margin - 1) + "└" + axis + "\n" +
          under.substr(0, under.find_last_not_of(' ') + 1) + "\n";
  const std::string label = cut(without_markup(panel.x.label), columns);
  text += blanks(margin + (columns - width_of(label)) / 2) + label + "\n";
  if (panel.scale) text += scale_line(*panel.scale, margin, size.columns, in_colour);
  return text + wrapped(entries, margin, size.columns);
}

}  // namespace haff::campaign
