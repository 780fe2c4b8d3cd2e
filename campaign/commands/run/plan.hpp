// SPDX-License-Identifier: GPL-3.0-or-later

// `campaign plan`: a grid becomes jobs in the store.
#pragma once

#include <filesystem>

namespace haff::campaign {

struct PlanOptions {
  std::filesystem::path grid;
  std::filesystem::path store;
  bool dry_run = false;  // show what would happen, touch nothing
  bool json = false;     // print for programs
  bool replace = false;  // what is planned and not in the grid goes
};

// Adds what is missing and prints what the campaign will cost; returns an ExitCode. Throws
// schema::GridError before anything is touched.
int plan(const PlanOptions& options);

}  // namespace haff::campaign
