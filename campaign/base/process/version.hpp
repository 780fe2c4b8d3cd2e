// SPDX-License-Identifier: GPL-3.0-or-later

// The version of this program.
#pragma once

#include <string>

namespace haff::campaign {

// Version and commit, as kept with each job: "0.1.0 (1a2b3c4d)".
std::string code_version();

// For --version: also the compiler and the SIMD instructions in use.
std::string version_text();

}  // namespace haff::campaign
