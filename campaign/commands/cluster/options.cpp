// SPDX-License-Identifier: GPL-3.0-or-later

// The options of split, merge, recall, submit, task.
#include "campaign/commands/options.hpp"

#include "campaign/base/process/machine.hpp"

namespace haff::campaign {

namespace {

constexpr int most_rounds = 1000;
constexpr int default_rounds = 20;
constexpr double default_put_back_every = 600;  // [s]
constexpr int most_shards = 100'000;

}  // namespace

CLI::App* add_split(CLI::App& app, SplitOptions& options) {
  auto* command =
      app.add_subcommand("split", "Lend pending jobs to shards, to be run on other machines");
  command->add_option("--into", options.into, "How many shards, at most")
      ->check(CLI::Range(1, most_shards))
      ->type_name("K")
      ->required();
  command->add_option("--out", options.out, "Folder to write them to")
      ->type_name("DIR")
      ->capture_default_str();
  command->add_option("--workers", options.workers, "Workers of each shard, for the expected time")
      ->check(CLI::Range(1, most_workers))
      ->type_name("K")
      ->capture_default_str();
  command->add_flag("--dry-run", options.dry_run, "Print the division; write and lend nothing");
  command->footer(examples(R"(  campaign split --into 4
  campaign split --into 64 --workers 8 --dry-run
  campaign run --store shards/shard-001.db     on another machine, like any store
  campaign merge shards/shard-*.db             when they have ended, or before

Jobs that are lent are not run here. A shard holds all that its jobs start from. Work is divided by
expected CPU time, the longest job first.)"));
  return command;
}

CLI::App* add_merge(CLI::App& app, MergeOptions& options) {
  auto* command = app.add_subcommand("merge", "Bring home what shards have computed");
  command->add_option("SHARD", options.shards, "Shards, as campaign split wrote them")
      ->type_name("FILE...")
      ->required();
  command->footer(examples(R"(  campaign merge shards/shard-*.db

Shards may be merged in any order, any number of times, before they have ended, and while a run is
on. Rows that are here already are compared, in every bit, and the others are added. Exit code 1 if a
shard is refused: it is of another campaign, damaged, or contradicts what the store has.)"));
  return command;
}

CLI::App* add_recall(CLI::App& app, RecallOptions& options) {
  auto* command = app.add_subcommand("recall", "Take back the jobs that a shard will not finish");
  command->add_option("SHARD", options.shards, "Names of shards, or their files")
      ->type_name("NAME...")
      ->required();
  command->footer(examples(R"(  campaign recall shard-003
  campaign recall scratch/shard-003.db     what is in this file is merged first)"));
  return command;
}

CLI::App* add_submit(CLI::App& app, SubmitOptions& options) {
  ClusterOptions& cluster = options.cluster;
  cluster.folder = "shards";
  cluster.put_back_every = default_put_back_every;
  cluster.rounds = default_rounds;
  auto* command = app.add_subcommand("submit", "Run all that is pending on a cluster, by Slurm");
  command->add_option("--tasks", cluster.tasks, "How many tasks, at most")
      ->check(CLI::Range(1, most_shards))
      ->type_name("K")
      ->required();
  command->add_option("--cpus", cluster.cpus, "Processors of each task, a worker for each")
      ->check(CLI::Range(1, most_workers))
      ->type_name("C")
      ->capture_default_str();
  add_duration(command, "--time", cluster.seconds, "Time limit of a task: 45m, 4h, 1d")->required();
  command
      ->add_option("--rounds", cluster.rounds,
                   "At most this many rounds: work that is left is submitted again")
      ->check(CLI::Range(0, most_rounds))
      ->type_name("R")
      ->capture_default_str();
  add_duration(command, "--put-back-every", cluster.put_back_every,
               "How often a task saves its shard: a node that dies costs at most that")
      ->default_str("10m");
  command->add_option("--out", cluster.folder, "Folder of shards, scripts and logs")
      ->type_name("DIR")
      ->capture_default_str();
  command->add_flag("--dry-run", options.dry_run, "Print scripts and sbatch lines; submit nothing");
  command->add_option("--round", options.round)->group("");  // given by the job after a round
  command->add_option("SBATCH", cluster.sbatch_options, "After --: further options of sbatch")
      ->type_name("OPTION...");
  command->footer(examples(R"(  campaign submit --tasks 40 --cpus 8 --time 4h
  campaign submit --tasks 40 --cpus 8 --time 4h --dry-run
  campaign submit --tasks 40 --cpus 8 --time 4h -- -p long -A phys
  campaign status                              which shard is where, and how far
  campaign figures                             with what has come home so far

A task works on a disk of its node ($SLURM_TMPDIR, $TMPDIR or /tmp), stops in time before its limit
and on Slurm's signals, and puts its shard back. When all tasks have ended, a job merges the shards;
if work is left, or targets need more seeds, it submits the next round.)"));
  return command;
}

CLI::App* add_task(CLI::App& app, TaskOptions& options) {
  options.workers = processors();
  options.put_back_every = default_put_back_every;
  auto* command = app.add_subcommand("task", "Work on one shard, as a task of a batch system");
  command->add_option("SHARD", options.shard, "The shard, as campaign split wrote it")
      ->type_name("FILE")
      ->required();
  command->add_option("--workers", options.workers, "Worker processes")
      ->check(CLI::Range(1, most_workers))
      ->type_name("K")
      ->capture_default_str();
  add_duration(command, "--max-time", options.max_seconds, "Stop computing after this time");
  add_duration(command, "--put-back-every", options.put_back_every, "How often the shard is saved")
      ->default_str("10m");
  command->footer(examples(R"(  campaign task --workers 8 --max-time 3h50m shards/shard-001.db

The shard is copied to $SLURM_TMPDIR, $TMPDIR or /tmp, run there, and put back by copying and
renaming, from time to time and at the end; signals stop it in order.)"));
  return command;
}

}  // namespace haff::campaign
