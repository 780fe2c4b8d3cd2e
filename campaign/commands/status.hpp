// `campaign status`: where a campaign stands, and what to type next.
#pragma once

#include <filesystem>

#include "schema/store.hpp"

namespace haff::campaign {

// Prints it, for people or as JSON; returns an ExitCode.
int status(const std::filesystem::path& store, bool json);

// What a run says at its end: the table of tau_c, failures, the next command.
void print_outcome(const schema::Reader& store);

}  // namespace haff::campaign
