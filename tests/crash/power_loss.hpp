// SPDX-License-Identifier: GPL-3.0-or-later

// The possible contents of a disk after power loss, made from a record of the requests to it.
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

// The fate of writes that were not synced. A file is certain up to its last sync; what was written
// later may be on the disk or not. The same holds for the creation and deletion of files until the
// folder is synced.
enum class Fate {
  none,          // all writes are lost
  all,           // all writes arrived, as after a kill
  prefix,        // the first writes arrived, and sectors of the next one
  some_pages,    // any whole pages of 4096 bytes arrived
  some_sectors,  // any sectors of 512 bytes arrived
  zeros,         // file sizes arrived, but only part of the contents
  junk,          // some sectors hold bytes that were never written
  store_first,   // all writes to the store arrived, and few to its log
  log_first,     // the reverse
};
inline constexpr int fates = 9;

// Writes the store's files into a folder, as they may be after the first `count` operations. `name`
// is the name of the store.
void make_image(const std::vector<Operation>& operations, std::size_t count, Fate fate,
                std::mt19937_64& random, const std::filesystem::path& folder,
                const std::string& name);

}  // namespace haff::tests
