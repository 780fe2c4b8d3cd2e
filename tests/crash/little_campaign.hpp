// SPDX-License-Identifier: GPL-3.0-or-later

// The small campaign that is killed, that loses power, or whose disk fails: the program, its store,
// and the rows that the store must hold in the end.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace haff::tests {

// `campaign`, with a disk that can be told to fail (faulty_disk.cpp).
inline constexpr const char* program = HAFF_CAMPAIGN_FAULTY;
inline constexpr const char* store_name = "c.db";

// A grid with every effect and every observable, so that every table has rows.
std::string grid(double tau_max, int seeds);

struct Result {
  int exit_code = 0;  // 128 + signal if a signal ended it; 124 after a minute
  std::string said;
};

std::string text_of(const std::filesystem::path& file);
bool contains(const std::string& text, const char* part);

// Runs the program in the folder, with these environment variables.
Result run_program(const std::filesystem::path& folder, const std::string& words,
                   const std::string& environment = "");
// Runs the program on the folder's own store.
Result shell(const std::filesystem::path& folder, const std::string& words,
             const std::string& environment = "");

// Throws the program's output as an error if its exit code is not 0.
void must_succeed(const Result& result);

// All physics in a store, reals with all their digits.
std::string rows(const std::filesystem::path& folder);

// Runs again, and plans again where jobs may be missing, until all jobs are done. Returns what went
// wrong on the way, or nothing.
std::optional<std::string> complete(const std::filesystem::path& folder, bool may_lack_jobs,
                                    const std::string& expected);

}  // namespace haff::tests
