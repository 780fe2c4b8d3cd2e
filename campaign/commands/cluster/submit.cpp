// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/commands/cluster/submit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "campaign/accuracy/targets/more_realizations.hpp"
#include "campaign/accuracy/targets/targets.hpp"
#include "campaign/base/output/output.hpp"
#include "campaign/base/process/exit_code.hpp"
#include "campaign/base/text/command_text.hpp"
#include "campaign/base/text/duration.hpp"
#include "campaign/base/text/error_text.hpp"
#include "campaign/base/text/number_text.hpp"
#include "campaign/cluster/merge.hpp"
#include "campaign/cluster/split.hpp"
#include "campaign/cluster/submission.hpp"
#include "campaign/cluster/subprocess.hpp"
#include "campaign/commands/run/status.hpp"
#include "campaign/run/abandoned.hpp"

namespace haff::campaign {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

// How long sbatch may refuse a round that the job after another one submits: no user is there to
// try again.
constexpr std::chrono::seconds unattended_patience = 10min;

std::chrono::seconds patience(const SubmitOptions& options) {
  return options.round == 0 ? 0s : unattended_patience;
}

// ---- what came home ---------------------------------------------------------------------------

void remove_file(const fs::path& path) {
  std::error_code ignored;
  fs::remove(path, ignored);
}

// Merges one shard and removes its file, which then holds nothing that the store lacks. Returns
// whether it brought anything. After an error of the store itself, or of the disk, the shard stays
// out and can come home later.
bool bring_home(schema::Store& store, const schema::Shard& shard) try {
  const MergeOutcome outcome = merge(store, shard.path);
  store.recall(shard.name);
  remove_file(shard.path);
  remove_file(shard.path.string() + ".task");  // a task that Slurm has lost sight of stops then
  say("{}: {} of {} jobs went on, {} new rows\n", shard.name, count_text(outcome.advanced),
      count_text(outcome.jobs), count_text(outcome.rows));
  return outcome.rows > 0 || outcome.advanced > 0;
} catch (const schema::Unavailable&) {
  throw;
} catch (const schema::StoreError& error) {
  complain("campaign: {}; what it has not sent home is computed again\n", error_text(error));
  store.recall(shard.name);
  return false;
}

// ---- rounds submitted before ------------------------------------------------------------------

[[noreturn]] void refuse(const OpenRound& round, const ClusterOptions& options) {
  throw std::runtime_error(fmt::format(
      "round {} is at work, as Slurm job {}, and job {} will merge it and go on; see: {}. To stop "
      "it: scancel {} {}",
      round.round.number, round.round.tasks_job, round.round.merge_job,
      command_text("status", options.store), round.round.merge_job, round.round.tasks_job));
}

// Reports on the rounds before. Returns an ExitCode if one is at work, and nothing is to be done
// now.
std::optional<int> look_after_rounds(schema::Store& store, const SubmitOptions& options) {
  const ClusterOptions& cluster = options.cluster;
  const bool is_user = options.round == 0;
  const auto ended = is_user ? std::nullopt : std::optional(options.round - 1);
  bool has_tried = false, has_brought = false;
  for (OpenRound& open : open_rounds(store, cluster.folder, ended)) {
    if (open.has_tasks && !open.has_merge) {
      enqueue_merge(cluster, open.round, patience(options));
      say("Round {} is at work, as Slurm job {}, but the job that is to merge it was gone: it is "
          "submitted again, as job {}.\n",
          open.round.number, open.round.tasks_job, open.round.merge_job);
      return exit_complete;
    }
    if (open.has_tasks || open.has_merge) {
      if (is_user) refuse(open, cluster);
      return exit_complete;
    }
    for (const schema::Shard& shard : open.shards) has_brought |= bring_home(store, shard);
    has_tried |= !open.round.tasks_job.empty();
  }
  if (!is_user && has_tried && !has_brought)
    throw std::runtime_error(
        fmt::format("no task has brought anything home, so none is submitted again; see the logs "
                    "in {}, and then: {}",
                    cluster.folder.string(), submit_line(cluster)));
  return std::nullopt;
}

// ---- what is submitted ------------------------------------------------------------------------

int next_number(const fs::path& folder) {
  const auto records = read_records(folder);
  return records.empty() ? 1 : records.back().number + 1;
}

int dry_run(const ClusterOptions& options) {
  const schema::Reader store(options.store);
  Round round{
      .number = next_number(options.folder), .shards = {}, .tasks_job = {}, .merge_job = {}};
  round.shards.resize(divide(store.jobs(), options.tasks).size());
  if (round.shards.empty()) {
    say("No job is pending: there is nothing to submit.\n");
    return exit_complete;
  }
  say("# {}\n{}\n# {}\n{}\n{}\n{}\n",
      round_file(options.folder, round.number, ".tasks.sh").string(), tasks_script(options, round),
      round_file(options.folder, round.number, ".merge.sh").string(), merge_script(options, round),
      shell_line(tasks_command(options, round)), shell_line(merge_command(options, round)));
  say("Nothing was written or submitted.\n");
  return exit_complete;
}

// How many rounds a task of this length takes, as far as is known.
std::string expected_rounds(const ClusterOptions& options, double makespan) {
  const double rounds = std::ceil(makespan / (options.seconds - reserve(options)));
  if (rounds <= 1) return "";
  return fmt::format(" That takes some {:.0f} rounds{}.", rounds,
                     rounds > options.rounds
                         ? fmt::format(", more than the {} that --rounds allows", options.rounds)
                         : "");
}

int submit_round(schema::Store& store, const SubmitOptions& options, int number) {
  const ClusterOptions& cluster = options.cluster;
  Round round{.number = number, .shards = {}, .tasks_job = {}, .merge_job = {}};
  // What is lent is recorded first; otherwise the store would not know to which shard.
  for (const WrittenShard& shard : planned_shards(store, cluster.tasks, cluster.folder))
    round.shards.push_back(shard.path);
  write_record(cluster.folder, round);
  double makespan = 0;
  try {
    const auto shards = split(store, cluster.tasks, cluster.folder);
    round.shards.clear();
    for (const WrittenShard& shard : shards) {
      round.shards.push_back(shard.path);
      makespan = std::max(makespan, shard.share.makespan(cluster.cpus));
    }
    enqueue(cluster, round, patience(options));
  } catch (...) {
    for (const schema::Shard& shard : store.shards())
      if (std::ranges::find(round.shards, shard.path) != round.shards.end()) {
        store.recall(shard.name);
        remove_file(shard.path);
      }
    remove_file(round_file(cluster.folder, number, ".json"));
    throw;
  }
  say("Round {}: {} task{} as Slurm job {}, merged by job {}. Expected: {} of computing for the "
      "longest task.{}\nTo stop: scancel {} {}; later, to bring home what was computed and go on: "
      "{}\n",
      number, round.shards.size(), round.shards.size() == 1 ? "" : "s", round.tasks_job,
      round.merge_job, duration_text(makespan), expected_rounds(cluster, makespan), round.merge_job,
      round.tasks_job, submit_line(cluster));
  return exit_complete;
}

int explain_other_schedulers(const ClusterOptions& options) {
  const std::string folder = shell_word(options.folder.string());
  const std::string all = shell_word((fs::absolute(options.folder) / "").string()) + "shard-*.db";
  const std::string task = fmt::format("task --workers {}", options.cpus);
  const std::string run_task = shell_word(this_program()) + ' ' + task;
  const std::string of_pbs =
      fmt::format(R"x({} "$(ls {} | sed -n "${{PBS_ARRAY_INDEX}}p")")x", run_task, all);
  const std::vector<std::string> of_condor{
      "%s\\n", "executable = " + this_program(), "arguments = " + task + " $(shard)",
      fmt::format("request_cpus = {}", options.cpus),
      "queue shard matching files " + (fs::absolute(options.folder) / "shard-*.db").string()};
  complain(
      "campaign: there is no sbatch here, so nothing was submitted. Under another scheduler:\n"
      "  {0}\n"
      "then give each shard to a task, by one of\n"
      "  GNU parallel  parallel -j {1} {2} {{}} ::: {3}\n"
      "  PBS           echo {4} | qsub -J 1-{1} -l select=1:ncpus={5}\n"
      "  HTCondor      printf {6} | condor_submit\n"
      "and bring home what they computed, as often as you like:\n"
      "  {7}\n",
      command_text(fmt::format("split --into {} --out {}", options.tasks, folder), options.store),
      options.tasks, run_task, all, quoted_word(of_pbs), options.cpus, shell_line(of_condor),
      command_text("merge " + folder + "/shard-*.db", options.store));
  return exit_failed;
}

}  // namespace

int submit(const SubmitOptions& given) {
  if (!given.dry_run && !find_program("sbatch")) return explain_other_schedulers(given.cluster);
  SubmitOptions options = given;
  ClusterOptions& cluster = options.cluster;
  cluster.store = fs::absolute(cluster.store);
  cluster.folder = fs::absolute(cluster.folder).lexically_normal();
  if (options.dry_run) return dry_run(cluster);

  schema::Store store = schema::Store::open(cluster.store);
  const SubmissionLock lock(cluster.folder);
  take_back_from_the_dead(store);
  if (const auto exit_code = look_after_rounds(store, options)) return *exit_code;
  keep_predictions(store);
  add_realizations(store, store.targets(), std::nullopt);

  const schema::Summary summary = store.summary();
  if (summary.claimable + summary.waiting == 0) {
    print_outcome(store);
    return summary.jobs.at(schema::Status::failed) > 0 ? exit_failed : exit_complete;
  }
  if (cluster.rounds == 0) {
    say("Work is left after the last round that --rounds allows.\nNext: {}\n",
        submit_line(cluster));
    return exit_out_of_time;
  }
  return submit_round(store, options, next_number(cluster.folder));
}

int task(const TaskOptions& options) {
  return work_on_shard(options);
}

}  // namespace haff::campaign
