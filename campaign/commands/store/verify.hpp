// SPDX-License-Identifier: GPL-3.0-or-later

// `campaign verify`: is the store sound, and did the physics hold?
#pragma once

#include <filesystem>
#include <string>

namespace haff::campaign {

struct VerifyOptions {
  std::filesystem::path store;
  bool repair = false;
  bool json = false;
  std::string recompute = {};  // "all", a job's number, "5%"; empty: nothing is computed again
};

// Prints what is wrong, if anything, and what helps, or the same as JSON; returns an ExitCode.
int verify(const VerifyOptions& options);

}  // namespace haff::campaign
