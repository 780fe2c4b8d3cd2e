// SPDX-License-Identifier: GPL-3.0-or-later

// The small campaign that is killed, loses power and whose disk fails: the program, its store, what
// must be in there in the end.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace haff::tests {

// `campaign`, with a disk that can be told to fail (faulty_disk.cpp).
inline constexpr const char* program = HAFF_CAMPAIGN_FAULTY;
inline constexpr const char* store_name = "c.db";

// Every effect and every observable, so that every table has rows.
std::string grid(double tau_max, int seeds);

struct Result {
  int exit_code = 0;  // 128 + signal if one ended it; 124 after a minute
  std::string said;
};

std::string text_of(const std::filesystem::path& file);
bool contains(const std::string& text, const char* part);

// Runs the program in the folder, with these variables before its name.
Result run_program(const std::filesystem::path& folder, const std::string& words,
                   const std::string& environment = "");
// The same, on the folder's own store.
Result shell(const std::filesystem::path& folder, const std::string& words,
             const std::string& environment = "");

// Throws what the program said if its exit code is not 0.
void must_succeed(const Result& result);

// All that the physics of a store is, reals with all their digits.
std::string rows(const std::filesystem::path& folder);

// Runs again, and plans again where jobs may be lacking, until all is done: what is wrong on the
// way, or nothing.
std::optional<std::string> complete(const std::filesystem::path& folder, bool may_lack_jobs,
                                    const std::string& expected);

}  // namespace haff::tests
