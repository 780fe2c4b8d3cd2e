// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/commands/results/export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "campaign/base/process/exit_code.hpp"
#include "campaign/base/text/command_text.hpp"
#include "campaign/base/text/job_text.hpp"
#include "campaign/base/text/number_text.hpp"
#include "campaign/base/text/text_table.hpp"
#include "campaign/commands/json_output.hpp"
#include "campaign/state/extended_xyz.hpp"
#include "campaign/state/restore.hpp"
#include "engine/simulation.hpp"
#include "schema/store/store.hpp"

namespace haff::campaign {
namespace {

// A moment as a user types it may differ by this from the one that is stored. [relative]
constexpr double rounding = 1e-9;

bool is_at(double moment, double asked) {
  return std::abs(moment - asked) <= rounding * std::max(1.0, std::abs(asked));
}

class Export {
 public:
  Export(const std::filesystem::path& path, std::int64_t job_id, std::ostream& out)
      : store_(path), row_(store_.job(job_id)), snapshots_(store_.snapshots(job_id)), out_(out) {}

  void last_state() {
    const auto state = newest_state(store_, row_.job_id, row_.job);
    if (!state)
      throw schema::NameError(fmt::format("{}: no state of job {} ({}) is stored; {}",
                                          store_.path().string(), row_.job_id, describe(row_.job),
                                          why_no_state()));
    write(*state, 2 * static_cast<double>(state->collisions) / state->particles());
  }

  void snapshot_at(const char* axis, double schema::SnapshotInfo::*moment, double asked) {
    const auto found = std::ranges::find_if(
        snapshots_, [&](const schema::SnapshotInfo& info) { return is_at(info.*moment, asked); });
    if (found == snapshots_.end())
      throw schema::NameError(fmt::format("{}: job {} ({}) has no snapshot at {} = {}; {}",
                                          store_.path().string(), row_.job_id, describe(row_.job),
                                          axis, number_text(asked), what_there_is()));
    write(*found);
  }

  void all_snapshots() {
    if (snapshots_.empty())
      throw schema::NameError(fmt::format("{}: job {} ({}) has no snapshot; {}",
                                          store_.path().string(), row_.job_id, describe(row_.job),
                                          what_there_is()));
    for (const schema::SnapshotInfo& info : snapshots_) write(info);
  }

  void print_list(bool json) const {
    const auto state = last_checkpoint();
    if (json) {
      nlohmann::ordered_json list = nlohmann::ordered_json::array();
      for (const schema::SnapshotInfo& info : snapshots_)
        list.push_back({{"what", "snapshot"},
                        {"tau", info.tau},
                        {"time", info.time},
                        {"collisions", info.collisions},
                        {"bytes", info.bytes}});
      if (state)
        list.push_back({{"what", "last state"},
                        {"tau", state->tau},
                        {"time", nullptr},
                        {"collisions", state->collisions},
                        {"bytes", state->bytes}});
      return print_json(list);
    }
    TextTable table({{"", Align::left}, {"tau"}, {"time"}, {"collisions"}, {"size"}});
    for (const schema::SnapshotInfo& info : snapshots_)
      table.add({"snapshot", number_text(info.tau), number_text(info.time),
                 count_text(info.collisions), bytes_text(static_cast<double>(info.bytes))});
    if (state)
      table.add({"last state", number_text(state->tau), no_value, count_text(state->collisions),
                 bytes_text(static_cast<double>(state->bytes))});
    out_ << (table.empty() ? fmt::format("Job {} has no snapshot, and no state yet\n", row_.job_id)
                           : table.text());
  }

  void finish() {
    out_.flush();
    if (!out_) throw std::runtime_error("the state could not be written; is the disk full?");
  }

 private:
  std::optional<schema::CheckpointInfo> last_checkpoint() const {
    for (const schema::CheckpointInfo& info : store_.checkpoints())
      if (info.job_id == row_.job_id) return info;
    return std::nullopt;
  }

  // A state is stored where the gas is synchronized: at the first such moment from checkpoint_every
  // on, and at the last one of the run.
  std::string why_no_state() const {
    const double period = engine::synchronization_period;
    if (row_.tau_max < period)
      return fmt::format(
          "states are stored at multiples of tau = {}, and it ends at tau = {}; list "
          "the moments of interest in the grid's \"snapshots_at\"",
          number_text(period), number_text(row_.tau_max));
    const double first = std::min(std::max(1.0, std::ceil(row_.checkpoint_every / period)),
                                  std::floor(row_.tau_max / period));
    return fmt::format("run it at least to its first checkpoint, tau = {}, with: {}",
                       number_text(first * period), command_text("run", store_.path()));
  }

  std::string what_there_is() const {
    if (row_.job.snapshots_at.empty())
      return "its grid has no \"snapshots_at\", and without an option its last state is exported";
    std::string list;
    constexpr std::size_t most = 10;
    for (std::size_t k = 0; k < std::min(most, snapshots_.size()); ++k)
      list += fmt::format("{}{}", k == 0 ? "" : ", ", number_text(snapshots_[k].tau));
    if (snapshots_.size() > most) list += " ...";
    return list.empty() ? fmt::format("its first one is still to come: {}",
                                      command_text("run", store_.path()))
                        : fmt::format("there are those at tau = {} (see --list)", list);
  }

  void write(const schema::SnapshotInfo& info) {
    const auto state = snapshot_state(store_, row_.job_id, row_.job, info.time);
    if (!state) throw std::runtime_error("a snapshot was removed while it was exported");
    write(*state, info.tau);
  }

  void write(const engine::State& state, double tau) {
    write_xyz(state,
              fmt::format("job_id={}{} n={} seed={} tau={} Time={} effects={}", row_.job_id,
                          row_.job.e ? fmt::format(" e={}", *row_.job.e) : "", row_.job.n,
                          row_.job.seed, tau, state.time, quoted_for_xyz(row_.job.effects.text())),
              out_);
  }

  schema::Reader store_;
  schema::JobRow row_;
  std::vector<schema::SnapshotInfo> snapshots_;  // by time
  std::ostream& out_;
};

}  // namespace

int export_state(const std::filesystem::path& path, const ExportOptions& options,
                 std::ostream& out) {
  if (options.json && !options.list)
    throw schema::NameError("--json goes with --list; what is exported is extended XYZ");
  Export job(path, options.job_id, out);
  if (options.list)
    job.print_list(options.json);
  else if (options.all)
    job.all_snapshots();
  else if (options.at_tau)
    job.snapshot_at("tau", &schema::SnapshotInfo::tau, *options.at_tau);
  else if (options.at_time)
    job.snapshot_at("time", &schema::SnapshotInfo::time, *options.at_time);
  else
    job.last_state();
  job.finish();
  return exit_complete;
}

}  // namespace haff::campaign
