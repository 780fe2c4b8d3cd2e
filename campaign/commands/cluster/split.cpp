// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/commands/cluster/split.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "campaign/base/output/output.hpp"
#include "campaign/base/process/exit_code.hpp"
#include "campaign/base/text/command_text.hpp"
#include "campaign/base/text/duration.hpp"
#include "campaign/base/text/number_text.hpp"
#include "campaign/base/text/text_table.hpp"
#include "campaign/cluster/split.hpp"
#include "campaign/commands/json_output.hpp"
#include "campaign/run/abandoned.hpp"

namespace haff::campaign {
namespace {

using nlohmann::ordered_json;

void print(const std::vector<WrittenShard>& shards, int workers) {
  TextTable table({{"shard", Align::left}, {"jobs"}, {"CPU time"}, {"longest job"}, {"time"}});
  double makespan = 0, cpu_seconds = 0;
  std::size_t jobs = 0;
  for (const WrittenShard& shard : shards) {
    const double time = shard.share.makespan(workers);
    table.add({shard.name, count_text(static_cast<long long>(shard.share.jobs.size())),
               duration_text(shard.share.cpu_seconds),
               duration_text(shard.share.longest_cpu_seconds), duration_text(time)});
    makespan = std::max(makespan, time);
    cpu_seconds += shard.share.cpu_seconds;
    jobs += shard.share.jobs.size();
  }
  say("{}\n{} shard{} with {} jobs, {} of CPU time, in {}.\n", table.text(), shards.size(),
      shards.size() == 1 ? "" : "s", jobs, duration_text(cpu_seconds),
      shards.front().path.parent_path().string());
  say("Expected with {} worker{} a shard, all shards at once: {}.\n", workers,
      workers == 1 ? "" : "s", duration_text(makespan));
}

ordered_json shards_json(const std::vector<WrittenShard>& shards, const SplitOptions& options) {
  ordered_json list = ordered_json::array();
  double makespan = 0;
  for (const WrittenShard& shard : shards) {
    const double time = shard.share.makespan(options.workers);
    makespan = std::max(makespan, time);
    list.push_back({{"shard", shard.name},
                    {"path", shard.path.string()},
                    {"jobs", shard.share.jobs.size()},
                    {"expected_cpu_seconds", shard.share.cpu_seconds},
                    {"longest_cpu_seconds", shard.share.longest_cpu_seconds},
                    {"expected_seconds", time}});
  }
  return {{"dry_run", options.dry_run},
          {"workers_of_shard", options.workers},
          {"expected_seconds", makespan},
          {"shards", list}};
}

}  // namespace

int split(const SplitOptions& options) {
  const auto shards = [&] {
    if (options.dry_run)
      return planned_shards(schema::Reader(options.store), options.into, options.out);
    schema::Store store = schema::Store::open(options.store);
    take_back_from_the_dead(store);
    return split(store, options.into, options.out);
  }();
  if (options.json) {
    print_json(shards_json(shards, options));
    return exit_complete;
  }
  if (shards.empty()) {
    say("No job is pending: there is nothing to lend.\n");
    return exit_complete;
  }
  print(shards, options.workers);
  if (options.dry_run) {
    say("Nothing was written or lent.\n");
    return exit_complete;
  }
  const std::string all = shell_word((options.out / "").string()) + "shard-*.db";
  say("Next: {} on another machine; then here: {}\n", command_text("run", shards.front().path),
      command_text("merge " + all, options.store));
  return exit_complete;
}

}  // namespace haff::campaign
