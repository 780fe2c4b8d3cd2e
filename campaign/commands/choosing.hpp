// SPDX-License-Identifier: GPL-3.0-or-later

// What --where and --order of a command choose.
#pragma once

#include <string>

#include "schema/store/planning/choice.hpp"

namespace haff::campaign {

// Throws schema::QueryError for SQL that is none, and for a condition that is true of no job at
// all: that is a slip of the keyboard.
schema::Choice choice_of(const schema::Reader& store, const std::string& where,
                         const std::string& order = {});

}  // namespace haff::campaign
