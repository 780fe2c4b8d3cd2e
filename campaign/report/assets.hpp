// SPDX-License-Identifier: GPL-3.0-or-later

// The parts of the page, as files within the program: its own HTML, CSS and JavaScript (web/), and
// the libraries that the build fetched from npm (assets.cmake).
#pragma once

#include <span>
#include <string_view>

namespace haff::campaign {

struct Asset {
  std::string_view name;  // of the file, without its folder
  std::string_view bytes;
};

// Empty where the build could not fetch the libraries.
std::span<const Asset> assets();

// Why it could not, and what to do; empty where it could.
std::string_view why_no_assets();

}  // namespace haff::campaign
