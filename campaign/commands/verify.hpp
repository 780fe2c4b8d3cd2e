// `campaign verify`: whether the store is sound, from SQLite's pages to the physics in it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "schema/store.hpp"

namespace haff::campaign {

// Prints what is wrong, if anything; returns an ExitCode.
int verify(const std::filesystem::path& store);

// What is wrong with one job: its identity, its samples, its results, its checkpoint. A job that
// is being worked on may be looked at too.
std::vector<std::string> faults_of(const schema::Reader& store, const schema::JobRow& row);

}  // namespace haff::campaign
