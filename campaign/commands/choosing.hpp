// SPDX-License-Identifier: GPL-3.0-or-later

// What --where and --order of a command choose.
#pragma once

#include <string>

#include "schema/store/planning/choice.hpp"

namespace haff::campaign {

// Throws schema::QueryError for text that is not SQL, and for a condition that holds for no job at
// all, which is a slip of the keyboard.
schema::Choice choice_of(const schema::Reader& store, const std::string& where,
                         const std::string& order = {});

}  // namespace haff::campaign
