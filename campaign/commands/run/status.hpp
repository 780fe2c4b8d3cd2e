// SPDX-License-Identifier: GPL-3.0-or-later

// `campaign status`: where a campaign stands, and what to type next.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "schema/store/store.hpp"

namespace haff::campaign {

struct StatusOptions {
  std::filesystem::path store;
  bool json = false;                  // for programs
  std::optional<double> watch_every;  // again and again, until a signal asks to stop [s]
};

// Prints it; returns an ExitCode.
int status(const StatusOptions& options);

// What a run says at its end: the table of tau_c, failures, the next command.
void print_outcome(const schema::Reader& store);

// The same as JSON: all that status has, the exit code of the run, and how many pending jobs it
// left alone since they were not chosen.
void print_outcome_json(const schema::Reader& store, int exit_code, std::int64_t not_chosen);

}  // namespace haff::campaign
