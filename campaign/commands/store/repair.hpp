// SPDX-License-Identifier: GPL-3.0-or-later

// `campaign verify --repair`: what the digests or the checks of jobs find wrong is computed again,
// and put right where it differs.
#pragma once

#include <cstdint>
#include <filesystem>

#include "campaign/job/recomputation.hpp"
#include "schema/store/store.hpp"

namespace haff::campaign {

// Says each thing that it does, or all of them as JSON.
int repair(const std::filesystem::path& path, bool json);

// Puts what came out of a second computation in the place of the rows that differ from it, and of
// the state if that differs or is damaged; what is left is digested as it is then.
struct Replaced {
  std::int64_t rows = 0;
  bool state = false;
};
Replaced replace(schema::Store& store, const schema::JobRow& row, const Recomputation& again,
                 bool has_damaged_state);

}  // namespace haff::campaign
