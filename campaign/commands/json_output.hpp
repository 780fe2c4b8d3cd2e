// SPDX-License-Identifier: GPL-3.0-or-later

// What --json prints.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace haff::campaign {

// A value over several lines, with an end of line. Bytes that are not UTF-8 appear as U+FFFD.
std::string indented_json(const nlohmann::ordered_json& value);

// The same on one line.
std::string one_line_json(const nlohmann::ordered_json& value);

// To stdout.
void print_json(const nlohmann::ordered_json& value);

// An error, for stderr: {"error": "...", "exit_code": 2}.
std::string error_json(const std::string& message, int exit_code);

}  // namespace haff::campaign
