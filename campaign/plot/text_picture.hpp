// SPDX-License-Identifier: GPL-3.0-or-later

// A plot as text, for a terminal: curves in dots of Braille, eight to a character (Unicode 28xx).
#pragma once

#include <string>

#include "campaign/plot/plot.hpp"

namespace haff::campaign {

struct TextSize {
  int columns = 80;
  int lines = 24;
};

// The first panel, its legend below it, at most as wide as asked. Curves are told apart by colours
// (escape sequences of 256 colours) or, without, by letters along them. Whatever text the plot has
// is made printable; there are no other control characters than those of colours and ends of lines.
std::string text_picture(const Plot& plot, const TextSize& size, bool in_colour);

// gnuplot's enhanced text without its markup: "a_2" for "{/:Italic a}_2".
std::string without_markup(std::string_view enhanced);

}  // namespace haff::campaign
