// SPDX-License-Identifier: GPL-3.0-or-later

// What a disk may hold after power was lost, made from a record of what was asked of it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "crash/trace.hpp"

namespace haff::tests {

struct Operation {
  TraceHeader header;
  std::string data;
};

std::vector<Operation> read_trace(const std::filesystem::path& file);

// What became of writes that were not synced. A file is synced up to its last sync; from then on
// anything may have happened, and so it may to making and deleting a file without syncing its
// folder.
enum class Fate {
  none,          // all are lost
  all,           // all arrived: a kill, rather
  prefix,        // the first ones, and sectors of the next
  some_pages,    // any, whole pages of 4096 bytes
  some_sectors,  // any, sectors of 512 bytes
  zeros,         // file sizes arrived, of the contents only a part
  junk,          // some sectors hold what was never written
  store_first,   // all to the store, few to its log
  log_first,     // the reverse
};
inline constexpr int fates = 9;

// Writes the store's files, as they may be after the first `count` operations, into a folder.
// `name` is that of the store.
void make_image(const std::vector<Operation>& operations, std::size_t count, Fate fate,
                std::mt19937_64& random, const std::filesystem::path& folder,
                const std::string& name);

}  // namespace haff::tests
