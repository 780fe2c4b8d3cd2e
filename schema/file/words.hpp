// SPDX-License-Identifier: GPL-3.0-or-later

// SQLite's errors in our words: which file, what is wrong, why, and what to do next.
#pragma once

#include <SQLiteCpp/Exception.h>

#include <filesystem>
#include <string>

namespace haff::schema {

// Throws this error as the type of error.hpp that it belongs to. `store` is the name that the user
// gave; the trouble that file_system.hpp remembers is the reason.
[[noreturn]] void raise(const std::filesystem::path& store, const SQLite::Exception& error);

// "; campaign.db-shm belongs to anna (mode 0644), ..." for the first of the store's files, or its
// folder, that this process may not write; or nothing.
std::string in_the_way(const std::filesystem::path& store);

// "process 4711 (sqlite3)" for each process that holds a lock on one of the store's files, this one
// excepted; or nothing.
std::string lock_holders(const std::filesystem::path& store);

}  // namespace haff::schema
