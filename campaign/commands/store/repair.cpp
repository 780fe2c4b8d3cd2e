// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/commands/store/repair.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "campaign/base/output/output.hpp"
#include "campaign/base/process/exit_code.hpp"
#include "campaign/base/text/command_text.hpp"
#include "campaign/base/text/job_text.hpp"
#include "campaign/base/text/number_text.hpp"
#include "campaign/base/text/printable.hpp"
#include "campaign/commands/json_output.hpp"
#include "campaign/commands/store/job_faults.hpp"
#include "campaign/job/recomputation.hpp"
#include "schema/store/store.hpp"

namespace haff::campaign {
namespace {

using schema::JobRow;
using schema::Part;
using schema::Store;

std::string job_name(const JobRow& row) {
  return fmt::format("job {} ({})", row.job_id, describe(row.job));
}

bool contains(const std::vector<Part>& parts, Part part) {
  return std::ranges::find(parts, part) != parts.end();
}

class Repair {
 public:
  Repair(const std::filesystem::path& path, bool json)
      : path_(path), json_(json), store_(Store::open(path)) {}

  int run() {
    const int code = mend();
    if (json_)
      print_json({{"repaired", mended_},
                  {"given_a_digest", digested_},
                  {"left", left_},
                  {"what", notes_}});
    return code;
  }

 private:
  template <class... Values>
  void note(fmt::format_string<Values...> text, Values&&... values) {
    std::string line = fmt::format(text, std::forward<Values>(values)...);
    if (!json_) return say("{}", line);
    if (line.ends_with('\n')) line.pop_back();
    notes_.push_back(std::move(line));
  }

  int mend() {
    if (const auto fault = fault_of_file()) {
      note(
          "{}: {}\nThe file itself is damaged, and rows that are put into it would not be safe. Go "
          "back to a backup of it, or save what can still be read with SQLite's .recover (see "
          "schema/README.md)\n",
          path_.string(), printable(*fault));
      return exit_failed;
    }
    for (const std::string& table : store_.wrong_tables()) take_table_as_it_is(table);
    for (const std::int64_t job_id : store_.job_ids()) mend_row_of_jobs(job_id);
    for (const schema::Kind kind : {schema::Kind::equilibration, schema::Kind::cooling})
      for (const std::int64_t job_id : store_.job_ids())
        if (!is_lost_.contains(job_id))
          if (const JobRow row = store_.job(job_id); row.job.kind == kind) mend_rows(row);
    note("{}: {} job{} put right, {} given a digest, {} left as {}\n", path_.string(), mended_,
         mended_ == 1 ? "" : "s", digested_, left_, left_ == 1 ? "it is" : "they are");
    if (reopened_ > 0) note("Next: {}\n", command_text("run", path_));
    return left_ == 0 ? exit_complete : exit_failed;
  }

  // Nothing is lost with indexes and statistics: they are made anew and checked again.
  std::optional<std::string> fault_of_file() {
    schema::Faults faults = store_.faults();
    if (faults.file.empty() && !faults.derived.empty()) {
      store_.make_derived_anew();
      note("{}: {}; all indexes and statistics are made anew from the tables\n", path_.string(),
           printable(faults.derived.front()));
      ++mended_;
      faults = store_.faults();
      faults.file.insert(faults.file.end(), faults.derived.begin(), faults.derived.end());
    }
    if (faults.file.empty()) return std::nullopt;
    return faults.file.front();
  }

  void take_table_as_it_is(const std::string& table) {
    store_.digest_table_again(table);
    note(
        "The table {} is not as it was written, and nothing tells what it was. It is taken as it "
        "is: look at it with {}\n",
        table, command_text("query 'SELECT * FROM " + table + "'", path_));
    ++mended_;
  }

  // A bit is turned back if that makes the row right. Otherwise the physics of the job is stored
  // twice, in its columns and in its identity; the other columns are believed, and the job's rows
  // are computed again.
  void mend_row_of_jobs(std::int64_t job_id) {
    const auto digests = store_.digests(job_id);
    if (contains(digests.without, Part::jobs)) store_.digest_again(job_id, Part::jobs);
    if (!contains(digests.wrong, Part::jobs)) return;
    if (const auto turned = store_.turn_bit_back(job_id)) {
      note("job {}: a bit of its row had flipped: {} is {} again, and was {}\n", job_id,
           turned->column, printable(turned->there), printable(turned->here));
      ++mended_;
      return;
    }
    try {
      const JobRow row = store_.job(job_id);
      auto stored =
          store_.query(fmt::format("SELECT identity FROM jobs WHERE job_id = {}", job_id));
      if (std::get<std::string>(stored.next().value().front()) != identity(row.job))
        throw schema::Damage("its columns do not make up its identity");
      store_.digest_again(job_id, Part::jobs);
      note(
          "{}: its row is not as it was written; its parameters are those of its identity, the "
          "rest is taken as it is: {} at tau = {}, to tau_max = {}. If that is too little, plan "
          "its "
          "grid again\n",
          job_name(row), name(row.status), number_text(row.progress.tau), number_text(row.tau_max));
      ++mended_;
      if (row.status == schema::Status::failed) reopen(row);
    } catch (const schema::Unavailable&) {
      throw;
    } catch (const std::exception& error) {
      note("job {}: its row cannot be put right: {}. Go back to a backup of the store\n", job_id,
           printable(error.what()));
      is_lost_.insert(job_id);
      ++left_;
    }
  }

  void mend_rows(const JobRow& row) {
    if (row.status == schema::Status::running || row.status == schema::Status::lent) return;
    const auto digests = store_.digests(row.job_id);
    const JobFaults faults = faults_of(store_, row);
    const bool is_finished =
        row.status == schema::Status::done || row.status == schema::Status::collapsed;
    const bool is_wrong = !digests.wrong.empty() || !faults.rows.empty();
    if (!is_wrong && !faults.state) {
      if (!digests.without.empty() && !faults.newer) give_digests(row, digests);
    } else if (is_finished) {
      compute_again(row, faults.state.has_value());
    } else {
      begin_again(row, faults.state ? *faults.state : faults.rows.front());
    }
  }

  void give_digests(const JobRow& row, const schema::DigestsOfJob& digests) {
    for (const Part part : digests.without) store_.digest_again(row.job_id, part);
    ++digested_;
  }

  void compute_again(const JobRow& row, bool has_damaged_state) {
    const std::string job = job_name(row);
    try {
      const Recomputation again = recompute(store_, row);
      const auto [replaced, is_state_new] = replace(store_, row, again, has_damaged_state);
      if (replaced == 0 && !is_state_new)
        note("{}: computed again; its rows are as they came out, and are digested anew\n", job);
      else
        note("{}: computed again; {} row{} differed and {} replaced{}\n", job, replaced,
             replaced == 1 ? "" : "s", replaced == 1 ? "is" : "are",
             is_state_new ? ", and so is its state" : "");
      ++mended_;
    } catch (const OtherPhysics& other) {
      note("{}: {}; it cannot be put right, only computed anew: {}\n", job, other.what(),
           command_text("retry", path_));
      ++left_;
    } catch (const schema::Unavailable&) {
      throw;
    } catch (const std::exception& error) {
      note("{}: could not be computed again: {}\n", job, printable(error.what()));
      ++left_;
    }
  }

  void begin_again(const JobRow& row, const std::string& why) {
    store_.drop_rows_after(row.job_id, before_all);
    note("{}: begins again, and what it had is dropped: {}\n", job_name(row), printable(why));
    reopen(row);
    ++mended_;
  }

  void reopen(const JobRow& row) {
    if (store_.restart(row.job_id)) ++reopened_;
  }

  static constexpr double before_all = -1;  // tau

  const std::filesystem::path& path_;
  bool json_;
  Store store_;
  std::vector<std::string> notes_;
  std::set<std::int64_t> is_lost_;
  int mended_ = 0, digested_ = 0, left_ = 0, reopened_ = 0;
};

}  // namespace

namespace {

bool has_other_state(const Store& store, const JobRow& row, const Recomputation& again) try {
  const auto here = store.checkpoint(row.job_id), there = again.store.checkpoint(again.job_id);
  return here && there && here->state != there->state;
} catch (const schema::Unavailable&) {
  throw;
} catch (const schema::Damage&) {
  return true;
}

}  // namespace

Replaced replace(Store& store, const JobRow& row, const Recomputation& again,
                 bool has_damaged_state) {
  Replaced replaced;
  for (const Part part : computed_parts)
    replaced.rows += store.replace_rows(row.job_id, part, again.store, again.job_id);
  store.replace_rows(row.job_id, Part::invariants, again.store, again.job_id);
  // Rows that came out different may belong to a disturbed trajectory, whose state is then wrong,
  // too.
  replaced.state = has_damaged_state || (replaced.rows > 0 && has_other_state(store, row, again)) ||
                   std::ranges::any_of(differences(store, row, again), [](const auto& each) {
                     return each.part == Part::checkpoints;
                   });
  if (replaced.state)
    store.replace_rows(row.job_id, Part::checkpoints, again.store, again.job_id);
  else
    store.digest_again(row.job_id, Part::checkpoints);
  return replaced;
}

int repair(const std::filesystem::path& path, bool json) {
  return Repair(path, json).run();
}

}  // namespace haff::campaign
