// SPDX-License-Identifier: GPL-3.0-or-later

// Plots as text.
#include "campaign/plot/text_picture.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

using namespace haff::campaign;

namespace {

Plot decay(int curves = 2) {
  Panel panel{.x = {.label = "{/:Italic τ}", .column = "tau"},
              .y = {.label = "{/:Italic a}_2", .column = "a2"}};
  for (int k = 1; k <= curves; ++k) {
    Curve curve{.name = "e", .legend = "{/:Italic e} = 0." + std::to_string(k)};
    for (int i = 0; i <= 50; ++i) {
      curve.x.push_back(i);
      curve.y.push_back(std::exp(-0.05 * k * i));
    }
    panel.curves.push_back(curve);
  }
  return {.panels = {panel}};
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::size_t width(const std::string& line) {
  return static_cast<std::size_t>(
      std::ranges::count_if(line, [](char c) { return (c & 0xc0) != 0x80; }));
}

}  // namespace

TEST_CASE("text picture: it has the given width and height, whatever it shows") {
  for (const int columns : {30, 80, 200})
    for (const int lines : {16, 24, 40}) {
      const auto text =
          lines_of(text_picture(decay(), {.columns = columns, .lines = lines}, false));
      CHECK(text.size() == static_cast<std::size_t>(lines) + 1);  // and one line of legend
      for (const std::string& line : text) CHECK(width(line) <= static_cast<std::size_t>(columns));
    }
}

TEST_CASE("text picture: curves are distinguished by letters or by colours") {
  const std::string plain = text_picture(decay(), {}, false);
  CHECK(plain.find('\x1b') == std::string::npos);
  CHECK(plain.find("a e = 0.1   b e = 0.2") != std::string::npos);
  const std::string coloured = text_picture(decay(), {}, true);
  CHECK(coloured.find("\x1b[38;5;") != std::string::npos);
  CHECK(coloured.find("── ") == std::string::npos);  // the sample is coloured, not the words
}

TEST_CASE("text picture: text of a store does not move the cursor") {
  Plot plot = decay();
  plot.panels[0].curves[0].legend = "x\x1b[2Jy\n";
  plot.panels[0].y.label = "\x1b]0;title\a";
  const std::string text = text_picture(plot, {}, false);
  CHECK(text.find('\x1b') == std::string::npos);
  CHECK(text.find('\a') == std::string::npos);
}

TEST_CASE("text picture: a falling curve reaches from the upper left to the lower right") {
  const auto text = lines_of(text_picture(decay(1), {}, false));
  const auto is_drawn = [](const std::string& line) {
    return line.find("\xe2\xa0") != std::string::npos ||
           line.find("\xe2\xa1") != std::string::npos ||
           line.find("\xe2\xa2") != std::string::npos || line.find("\xe2\xa3") != std::string::npos;
  };
  CHECK(is_drawn(text[1]));
  CHECK(is_drawn(text[20]));
}

TEST_CASE(
    "text picture: logarithmic axes have decades, and leave out values that are not above 0") {
  Plot plot = decay(1);
  plot.panels[0].y.logarithmic = true;
  plot.panels[0].curves[0].y = std::vector<double>(51, 1e-3);
  plot.panels[0].curves[0].y[0] = 10;
  plot.panels[0].curves[0].y[1] = -1;
  const std::string text = text_picture(plot, {}, false);
  CHECK(text.find(" 0.01┤") != std::string::npos);
  CHECK(text.find("  10┤") != std::string::npos);
}

TEST_CASE("text picture: equal values, one point, and no point are drawn") {
  Plot plot = decay(1);
  plot.panels[0].curves[0].y.assign(51, 2);
  CHECK_FALSE(text_picture(plot, {}, false).empty());
  plot.panels[0].curves[0].x = {1};
  plot.panels[0].curves[0].y = {1};
  CHECK_FALSE(text_picture(plot, {}, true).empty());
  plot.panels[0].curves.clear();
  CHECK_FALSE(text_picture(plot, {.columns = 1, .lines = 1}, true).empty());
}

TEST_CASE("text picture: markup in labels is removed") {
  CHECK(without_markup("{/:Italic γ} / {/:Italic γ}_0") == "γ / γ_0");
  CHECK(without_markup("a\\_b\\\\") == "a_b\\");
  CHECK(without_markup("{/:Italic") == "");
}
