// SPDX-License-Identifier: GPL-3.0-or-later

// The same text again and again, as it changes (`status --watch`).
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace haff::campaign {

// Prints what `make` returns, now and every so many seconds, until a signal asks to stop or stdout
// cannot be written. A terminal shows as much of the newest text as fits, on a screen of its own,
// and keeps the last one at the end. A file or a pipe gets all texts one after the other, with the
// time above each unless it is data. A text that cannot be made (an exception) ends the watch.
// Returns an ExitCode: 0.
int watch(const std::function<std::string()>& make, double every_seconds, bool is_data);

// The first lines of a text that fit on a screen of this size, each cut to its width; where lines
// are left out, the last line says how many.
std::vector<std::string> screen_of(std::string_view text, std::size_t columns, std::size_t lines);

}  // namespace haff::campaign
