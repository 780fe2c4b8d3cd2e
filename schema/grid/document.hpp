// SPDX-License-Identifier: GPL-3.0-or-later

// A JSON text read strictly. The JSON library alone would keep the last of two equal keys and
// would not say where a number overflows. Private to schema/.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "schema/grid/grid.hpp"

namespace haff::schema {

using Json = nlohmann::json;
using Pointer = Json::json_pointer;

// "first.json: /grids/1/e: " + what
GridError fault(const std::string& file, const Pointer& where, const std::string& what);

// A value as a message shows it: JSON, cut if long.
std::string shown(const Json& value);

// The shortest decimal within 1e-12 of the value: 0.85 for 0.8500000000000001. Whole numbers stay.
double shortest_decimal(double value);

// The document, without "$schema" at its top and without keys that begin with "_", which are for
// editors and for notes, and with its numbers as shortest_decimal() says. Throws GridError if it is
// not JSON (naming line and column), repeats a key, holds a number too large or too small for a
// double, or is nested beyond reason (naming the JSON pointer).
Json read_document(std::string_view text, const std::string& file);

}  // namespace haff::schema
