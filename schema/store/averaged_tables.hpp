// SPDX-License-Identifier: GPL-3.0-or-later

// The averaged tables of a store as a small SQLite file of their own: what a page or a mail can
// take along, and any reader of SQLite can ask.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "schema/store/store.hpp"

namespace haff::schema {

// A table beside them that a program has computed.
struct ComputedTable {
  std::string name;
  std::vector<std::string> columns;
  std::vector<std::vector<Value>> rows;
};

// The bytes of an SQLite file with the tables mean_series, mean_temperatures, mean_profiles,
// mean_tau_c, target_outcomes and job_effects, which hold the rows that the store's views of these
// names have now, the table jobs without what only a run needs, and the tables `beside`. Reals keep
// their bits.
// Throws Damage if rows that are averaged are not as they were written.
std::vector<std::byte> averaged_tables(const Reader& store,
                                       const std::vector<ComputedTable>& beside = {});

}  // namespace haff::schema
