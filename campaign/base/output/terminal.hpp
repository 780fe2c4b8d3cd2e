// SPDX-License-Identifier: GPL-3.0-or-later

// The terminal that something is printed on.
#pragma once

namespace haff::campaign {

struct TerminalSize {
  int columns = 80;
  int lines = 24;
};

// The size of the terminal behind a descriptor; 80 x 24 where there is none, or it does not say.
TerminalSize terminal_size(int descriptor);

// Whether it is a terminal that shows colours: not if NO_COLOR is set (https://no-color.org) or
// TERM is dumb.
bool shows_colours(int descriptor);

}  // namespace haff::campaign
