// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/commands/cluster/recall.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "campaign/base/output/output.hpp"
#include "campaign/base/process/exit_code.hpp"
#include "campaign/base/text/command_text.hpp"
#include "campaign/base/text/error_text.hpp"
#include "campaign/base/text/number_text.hpp"
#include "campaign/cluster/merge.hpp"
#include "campaign/commands/json_output.hpp"

namespace haff::campaign {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

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

// Merges the shard first: what it has stored so far need not be computed again.
struct Brought {
  std::optional<MergeOutcome> outcome = {};
  std::string error = {};  // why nothing came
};

Brought bring_what_is_there(schema::Store& store, const fs::path& path) {
  if (!fs::exists(path)) return {.error = path.string() + " is not there"};
  try {
    return {.outcome = merge(store, path)};
  } catch (const schema::StoreError& error) {
    return {.error = error_text(error)};
  }
}

void print(const std::string& shard, const Brought& brought, std::int64_t back) {
  if (brought.outcome)
    say("{}: {} new rows of {} jobs merged first.\n", shard, count_text(brought.outcome->rows),
        count_text(brought.outcome->jobs));
  else
    say("{}: {}; what it has not sent home is computed again.\n", shard, brought.error);
  say("{}: {} job{} pending again.\n", shard, count_text(back), back == 1 ? " is" : "s are");
}

ordered_json shard_json(const std::string& shard, const Brought& brought, std::int64_t back) {
  ordered_json object{{"shard", shard}, {"pending_again", back}};
  if (brought.outcome)
    object["new_rows"] = brought.outcome->rows;
  else
    object["error"] = brought.error;
  return object;
}

}  // namespace

int recall(const RecallOptions& options) {
  schema::Store store = schema::Store::open(options.store);
  const auto shards = store.shards();
  std::int64_t jobs = 0;
  ordered_json list = ordered_json::array();
  for (const std::string& word : options.shards) {
    const schema::Shard& shard = shard_named(shards, word, options.store);
    const bool names_file = fs::path(word).has_parent_path() && fs::exists(word);
    const Brought brought = bring_what_is_there(store, names_file ? fs::path(word) : shard.path);
    const std::int64_t back = store.recall(shard.name);
    if (options.json)
      list.push_back(shard_json(shard.name, brought, back));
    else
      print(shard.name, brought, back);
    jobs += back;
  }
  if (options.json)
    print_json({{"shards", list}});
  else if (jobs > 0)
    say("Next: {}\n", command_text("run", options.store));
  return exit_complete;
}

}  // namespace haff::campaign
