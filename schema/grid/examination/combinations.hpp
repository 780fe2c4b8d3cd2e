// SPDX-License-Identifier: GPL-3.0-or-later

// What goes together in a grid: effects with each other, with e and with the start. Private to
// schema/.
#pragma once

#include <string>

#include "schema/grid/source.hpp"

namespace haff::schema {

// Throws GridError where effects contradict each other, e or N.
void must_go_together(const std::string& file, const Source& source);

// Throws GridError where a start does not go with the other keys.
void must_have_a_start(const std::string& file, const Source& source);

}  // namespace haff::schema
