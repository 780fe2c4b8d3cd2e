// SPDX-License-Identifier: GPL-3.0-or-later

// Text from elsewhere, made safe to show. A store may come from another person: its text
// must not move the cursor of a terminal, end a line of a script, or become a tag of a page.
#pragma once

#include <string>
#include <string_view>

namespace haff::campaign {

// The same text on one line. Control characters (C0, DEL, C1, the line separators and the marks
// that turn the direction of writing), and bytes that are not UTF-8, appear as \x1b.
std::string printable(std::string_view text);

// The same line by line: ends of lines stay.
std::string printable_lines(std::string_view text);

// Printable text in XML or HTML, also inside an attribute: & < > " ' become entities.
std::string xml_escaped(std::string_view text);

}  // namespace haff::campaign
