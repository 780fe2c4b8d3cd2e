// SPDX-License-Identifier: GPL-3.0-or-later

// `campaign verify --repair`: rows and states that the digests or the checks of jobs find wrong are
// computed again, and put right where they differ.
#pragma once

#include <cstdint>
#include <filesystem>

#include "campaign/job/recomputation.hpp"
#include "schema/store/store.hpp"

namespace haff::campaign {

// Prints each step, or all of them as JSON.
int repair(const std::filesystem::path& path, bool json);

// Replaces the rows that differ from a second computation, and the state if it differs or is
// damaged, by those of that computation. The job is digested as it is then.
struct Replaced {
  std::int64_t rows = 0;
  bool state = false;
};
Replaced replace(schema::Store& store, const schema::JobRow& row, const Recomputation& again,
                 bool has_damaged_state);

}  // namespace haff::campaign
