// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/commands/cluster/merge.hpp"

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
#include "campaign/base/text/text_table.hpp"
#include "campaign/cluster/merge.hpp"
#include "campaign/commands/json_output.hpp"

namespace haff::campaign {

namespace {

using nlohmann::ordered_json;

// The outcome for one shard: it was merged, or it was refused.
struct Result {
  std::filesystem::path path;
  std::optional<MergeOutcome> outcome = {};
  std::string error = {};
};

std::vector<Result> merge_each(schema::Store& store,
                               const std::vector<std::filesystem::path>& shards) {
  std::vector<Result> results;
  for (const auto& path : shards) {
    results.push_back({.path = path});
    try {
      results.back().outcome = merge(store, path);
    } catch (const schema::StoreError& error) {
      results.back().error = error_text(error);
    }
  }
  return results;
}

void print(const std::vector<Result>& results) {
  TextTable table({{"shard", Align::left}, {"jobs"}, {"went on"}, {"new rows"}});
  for (const Result& result : results)
    if (result.outcome)
      table.add({result.outcome->shard, count_text(result.outcome->jobs),
                 count_text(result.outcome->advanced), count_text(result.outcome->rows)});
    else
      complain("campaign: {}\n", result.error);
  if (!table.empty()) say("{}", table.text());
}

ordered_json results_json(const std::vector<Result>& results, std::int64_t still_lent) {
  ordered_json list = ordered_json::array();
  for (const Result& result : results) {
    ordered_json one{{"path", result.path.string()}};
    if (result.outcome)
      one.update({{"shard", result.outcome->shard},
                  {"jobs", result.outcome->jobs},
                  {"went_on", result.outcome->advanced},
                  {"new_rows", result.outcome->rows}});
    else
      one["error"] = result.error;
    list.push_back(std::move(one));
  }
  return {{"shards", list}, {"still_lent", still_lent}};
}

std::int64_t still_lent(const schema::Store& store) {
  std::int64_t out = 0;
  for (const schema::Shard& shard : store.shards())
    if (!shard.returned) out += shard.unfinished;
  return out;
}

}  // namespace

int merge(const MergeOptions& options) {
  schema::Store store = schema::Store::open(options.store);
  const std::vector<Result> results = merge_each(store, options.shards);
  const std::int64_t out = still_lent(store);
  if (options.json) {
    print_json(results_json(results, out));
  } else {
    print(results);
    if (out > 0)
      say("{} job{} still lent. Merge again when {} ended, or take back what a lost shard had: "
          "{}\n",
          count_text(out), out == 1 ? " is" : "s are", out == 1 ? "it has" : "they have",
          command_text("recall SHARD", options.store));
  }
  const bool is_complete =
      std::ranges::all_of(results, [](const Result& result) { return result.outcome.has_value(); });
  return is_complete ? exit_complete : exit_failed;
}

}  // namespace haff::campaign
