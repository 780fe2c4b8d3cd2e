// SPDX-License-Identifier: GPL-3.0-or-later

// The SQL and JSON files of schema/, as text within the program (embed.cmake).
#pragma once

#include <span>
#include <string_view>

namespace haff::schema {

struct Embedded {
  std::string_view name;  // of the file, without its folder
  std::string_view text;
};

std::span<const Embedded> embedded();  // sorted by name

}  // namespace haff::schema
