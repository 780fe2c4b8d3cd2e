// SPDX-License-Identifier: GPL-3.0-or-later

// A grid's JSON against grid.schema.json, and one message that says what is wrong. Private to
// schema/.
#pragma once

#include <string>
#include <vector>

#include "schema/grid/document.hpp"

namespace haff::schema {

// Throws GridError at the deepest value that breaks a rule: the unknown key and the nearest known
// one, the key that is missing, or the value and what the schema describes in its place.
void check_rules(const Json& document, const std::string& file);

// Keys that every grid must have, here or among the defaults, except e, which depends on the
// effects.
std::vector<std::string> required_keys();

// What the schema says about the key of a grid, e.g. "a number of particles, ...".
std::string description(const std::string& key);

// The key's default, null if it has none.
Json default_value(const std::string& key);

// Whether a law of restitution leaves no e to choose.
bool decides_e(const std::string& law);

}  // namespace haff::schema
