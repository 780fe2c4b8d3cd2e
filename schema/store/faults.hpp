// SPDX-License-Identifier: GPL-3.0-or-later

// What is wrong with the file of a store, apart from what its rows say.
#pragma once

#include <string>
#include <vector>

namespace haff::schema {

class Database;

// One line a fault.
struct Faults {
  std::vector<std::string> file = {};     // tables: what they held may be lost
  std::vector<std::string> derived = {};  // indexes and statistics: made anew from the tables
  bool empty() const { return file.empty() && derived.empty(); }
};

// Checks the integrity of the file, the foreign keys, and what SQLite is told of the sizes of
// tables.
Faults faults_of(Database& database);

// Makes indexes and statistics anew. Within a transaction.
void make_derived_anew(Database& database);

}  // namespace haff::schema
