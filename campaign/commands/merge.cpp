#include "campaign/commands/merge.hpp"

#include <fmt/format.h>

#include "campaign/base/command_text.hpp"
#include "campaign/base/exit_code.hpp"
#include "campaign/base/number_text.hpp"
#include "campaign/base/output.hpp"
#include "campaign/base/text_table.hpp"
#include "campaign/cluster/merge.hpp"

namespace haff::campaign {

int merge(const MergeOptions& options) {
  schema::Store store = schema::Store::open(options.store);
  TextTable table({{"shard", Align::left}, {"jobs"}, {"went on"}, {"new rows"}});
  bool is_complete = true;
  for (const auto& path : options.shards) {
    try {
      const MergeOutcome outcome = merge(store, path);
      table.add({outcome.shard, count_text(outcome.jobs), count_text(outcome.advanced),
                 count_text(outcome.rows)});
    } catch (const schema::StoreError& error) {
      is_complete = false;
      complain("campaign: {}\n", error.what());
    }
  }
  if (!table.empty()) say("{}", table.text());

  std::int64_t out = 0;
  for (const schema::Shard& shard : store.shards())
    if (!shard.returned) out += shard.unfinished;
  if (out > 0)
    say("{} job{} still lent. Merge again when {} ended, or take back what a lost shard had: {}\n",
        count_text(out), out == 1 ? " is" : "s are", out == 1 ? "it has" : "they have",
        command_text("recall SHARD", options.store));
  return is_complete ? exit_complete : exit_failed;
}

}  // namespace haff::campaign
