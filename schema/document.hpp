// A JSON text read strictly. The JSON library alone would keep the last of two equal keys and
// would not say where a number overflows. Private to this folder.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "schema/grid.hpp"

namespace haff::schema {

using Json = nlohmann::json;
using Pointer = Json::json_pointer;

// "first.json: /grids/1/e: " + what
GridError fault(const std::string& file, const Pointer& where, const std::string& what);

// A value as a message shows it: JSON, cut if long.
std::string shown(const Json& value);

// The document. Throws GridError if it is not JSON (naming line and column), repeats a key, holds
// a number that no double can hold, or is nested beyond reason (naming the JSON pointer).
Json read_document(std::string_view text, const std::string& file);

}  // namespace haff::schema
