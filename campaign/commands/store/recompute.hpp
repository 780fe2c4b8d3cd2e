// SPDX-License-Identifier: GPL-3.0-or-later

// `campaign verify --recompute JOB|all|N%`: finished jobs once more, compared in every bit.
#pragma once

#include <filesystem>
#include <string>

namespace haff::campaign {

// What is wrong with the word that says which jobs; empty if nothing is.
std::string fault_of_choice(const std::string& word);

// Prints where they differ, in words or as JSON. `repair`: where a third computation gives the same
// as the second, it replaces what the store has.
int recompute_jobs(const std::filesystem::path& path, const std::string& which, bool repair,
                   bool json);

}  // namespace haff::campaign
