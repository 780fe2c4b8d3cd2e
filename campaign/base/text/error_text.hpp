// SPDX-License-Identifier: GPL-3.0-or-later

// What an error says to a user, with the command that would help.
#pragma once

#include <exception>
#include <string>

namespace haff::campaign {

// what(), and for an error of the store that has a remedy the command to type: "...; make it with:
// campaign plan GRID.json".
std::string error_text(const std::exception& error);

}  // namespace haff::campaign
