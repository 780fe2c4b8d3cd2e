#include "campaign/commands/recall.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "campaign/base/command_text.hpp"
#include "campaign/base/exit_code.hpp"
#include "campaign/base/number_text.hpp"
#include "campaign/base/output.hpp"
#include "campaign/cluster/merge.hpp"

namespace haff::campaign {
namespace {

namespace fs = std::filesystem;

const schema::Shard& shard_named(const std::vector<schema::Shard>& shards, const std::string& word,
                                 const fs::path& store) {
  const auto found = std::ranges::find_if(shards, [&](const schema::Shard& shard) {
    return shard.name == word || shard.name == fs::path(word).stem();
  });
  if (found != shards.end()) return *found;
  std::string names;
  for (const schema::Shard& shard : shards) names += (names.empty() ? "" : ", ") + shard.name;
  throw schema::NameError(fmt::format("{}: has lent nothing to '{}'; its shards: {}",
                                      store.string(), word, names.empty() ? "none" : names));
}

// What the shard has stored so far need not be computed again.
void bring_what_is_there(schema::Store& store, const schema::Shard& shard, const fs::path& path) {
  if (!fs::exists(path)) {
    say("{}: {} is not there; what it has not sent home is computed again.\n", shard.name,
        path.string());
    return;
  }
  try {
    const MergeOutcome outcome = merge(store, path);
    say("{}: {} new rows of {} jobs merged first.\n", shard.name, count_text(outcome.rows),
        count_text(outcome.jobs));
  } catch (const schema::StoreError& error) {
    complain("campaign: {}; what it has not sent home is computed again\n", error.what());
  }
}

}  // namespace

int recall(const RecallOptions& options) {
  schema::Store store = schema::Store::open(options.store);
  const auto shards = store.shards();
  std::int64_t jobs = 0;
  for (const std::string& word : options.shards) {
    const schema::Shard& shard = shard_named(shards, word, options.store);
    const bool names_file = fs::path(word).has_parent_path() && fs::exists(word);
    bring_what_is_there(store, shard, names_file ? fs::path(word) : shard.path);
    const std::int64_t back = store.recall(shard.name);
    say("{}: {} job{} pending again.\n", shard.name, count_text(back), back == 1 ? " is" : "s are");
    jobs += back;
  }
  if (jobs > 0) say("Next: {}\n", command_text("run", options.store));
  return exit_complete;
}

}  // namespace haff::campaign
