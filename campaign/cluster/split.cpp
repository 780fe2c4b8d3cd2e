// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/cluster/split.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <system_error>

#include "schema/file/flush.hpp"

namespace haff::campaign {
namespace {

namespace fs = std::filesystem;

// The largest number among names shard-001, shard-002, ...; 0 if there is none.
int last_number(const std::vector<schema::Shard>& shards) {
  int last = 0;
  for (const schema::Shard& shard : shards) {
    const std::string digits = shard.name.substr(shard.name.rfind('-') + 1);
    int number = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), number);
    last = std::max(last, number);
  }
  return last;
}

void must_be_free(const fs::path& path) {
  if (fs::exists(path))
    throw schema::StoreError(path.string() +
                             ": is there already; move it away, or name another folder with --out");
}

// Writes a shard under a name of its own and gives it the right one when it is whole and on the
// disk: a file of that name is never half a shard.
void write_shard(const schema::Store& store, const WrittenShard& shard) {
  fs::path unfinished = shard.path;
  unfinished += ".unfinished";
  const auto remove_leftovers = [&] {
    for (const char* suffix : {"", "-wal", "-shm", "-journal"})
      fs::remove(fs::path(unfinished.string() + suffix));
  };
  remove_leftovers();
  try {
    {
      schema::Store copy = schema::Store::create(unfinished);
      copy.become_shard(store.campaign_id(), shard.name);
      for (const std::int64_t job_id : shard.share.jobs) copy.take_over(store, job_id);
    }  // closed: all of it is in the file itself, with no log beside it
    if (!schema::flush_to_disk(unfinished))
      throw schema::DiskError(fmt::format("{}: cannot be written to the disk ({})",
                                          shard.path.string(),
                                          std::generic_category().message(errno)));
    fs::rename(unfinished, shard.path);
  } catch (...) {
    remove_leftovers();
    throw;
  }
}

}  // namespace

std::vector<WrittenShard> planned_shards(const schema::Reader& store, std::size_t count,
                                         const fs::path& folder) {
  std::vector<WrittenShard> shards;
  int number = last_number(store.shards());
  for (Share& share : divide(store.jobs(), count)) {
    const std::string name = fmt::format("shard-{:03}", ++number);
    shards.push_back({name, fs::absolute(folder) / (name + ".db"), std::move(share)});
    must_be_free(shards.back().path);
  }
  return shards;
}

std::vector<WrittenShard> split(schema::Store& store, std::size_t count, const fs::path& folder) {
  std::vector<WrittenShard> shards = planned_shards(store, count, folder);
  if (shards.empty()) return shards;

  fs::create_directories(folder);
  std::vector<schema::Loan> loans;
  loans.reserve(shards.size());
  for (const WrittenShard& shard : shards)
    loans.push_back({shard.name, shard.path, shard.share.jobs});
  store.lend(loans);
  try {
    for (const WrittenShard& shard : shards) write_shard(store, shard);
  } catch (...) {
    for (const WrittenShard& shard : shards) {
      store.recall(shard.name);
      std::error_code ignored;
      fs::remove(shard.path, ignored);
    }
    throw;
  }
  return shards;
}

}  // namespace haff::campaign
