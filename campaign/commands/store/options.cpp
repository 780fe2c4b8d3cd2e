// SPDX-License-Identifier: GPL-3.0-or-later

// The options of verify, retry, cancel, backup, upgrade.
#include "campaign/commands/options.hpp"

#include "campaign/commands/store/recompute.hpp"

namespace haff::campaign {

CLI::App* add_verify(CLI::App& app, VerifyOptions& options) {
  auto* command = app.add_subcommand(
      "verify", "Check the store: SQLite, digests of rows, checkpoints, physics, completeness");
  command->add_flag("--repair", options.repair,
                    "Compute again what is wrong, and put the rows right where they differ");
  command
      ->add_option("--recompute", options.recompute,
                   "Compute finished jobs again and compare every bit: a job's number, all, or a "
                   "part of them such as 5%")
      ->type_name("JOB|all|N%")
      ->check(CLI::Validator([](std::string& word) { return fault_of_choice(word); }, ""));
  command->footer(examples(R"(  campaign verify && echo sound
  campaign verify --recompute 12
  campaign verify --recompute 5% --store dense.db
  campaign verify --repair && campaign run
  campaign verify --recompute 12 --repair

Exit code 1 if something is wrong. Each row has a digest from the moment when it is written, so that
any bit that flips later is found. --recompute takes the CPU time of the jobs, finds rows that were
wrong when they were written, and changes nothing. --repair changes only what is wrong, and says what
it changed. Both together replace rows that differ from a second and a third computation, which must
agree.)"));
  return command;
}

CLI::App* add_retry(CLI::App& app, RetryCommand&) {
  auto* command = app.add_subcommand(
      "retry", "Reopen failed jobs and those whose checkpoint or rows are damaged");
  command->footer(examples("  campaign retry && campaign run"));
  return command;
}

CLI::App* add_cancel(CLI::App& app, CancelOptions& options) {
  auto* command =
      app.add_subcommand("cancel", "Take jobs that are no longer wanted out of the store");
  add_where(command, options.where, "Which jobs, a condition in SQL over the table jobs")
      ->required();
  command->add_flag("--delete", options.with_rows,
                    "Remove done jobs, too, with all that they have stored, and make the file "
                    "smaller");
  command->add_flag("--dry-run", options.dry_run, "Show what would become of each; change nothing");
  command->footer(examples(R"(  campaign cancel --where "e = 0.95 AND N > 100000" --dry-run
  campaign cancel --where "status = 'failed'"
  campaign cancel --where "n = 0.6" --delete

Planned jobs go. Those that were begun end where they are stored, and the next run completes them
there. Done jobs stay unless --delete is given. Equilibrations go with the last job that starts from
them, and so do targets of these gases. Jobs that a worker or a shard has are left alone and named,
with exit code 1. In the condition, N is the number of particles and roughness.beta the parameter of
an effect.)"));
  return command;
}

CLI::App* add_backup(CLI::App& app, BackupCommand& options) {
  auto* command =
      app.add_subcommand("backup", "Copy the store to another file, also while a run is on");
  command->add_option("FILE", options.to, "The copy; must not be there yet")
      ->type_name("FILE")
      ->required();
  command->footer(examples(R"(  campaign backup monday.db
  campaign backup /media/disk/dense.db --store dense.db

The copy holds the store as it is at one moment, in one file, and is checked. While a run is on,
part of the store is in a second file, campaign.db-wal: `cp campaign.db` alone would miss it.
Jobs that are being run are pending in the copy.)"));
  return command;
}

CLI::App* add_upgrade(CLI::App& app, UpgradeCommand&) {
  auto* command =
      app.add_subcommand("upgrade", "Bring a store of an older version of this program forward");
  command->footer(examples(R"(  campaign backup before.db && campaign upgrade

An older store can be read as it is; to plan and run in it takes this command, while nothing runs.
It is one transaction, and changes nothing if it is cut off. Older programs cannot use the store
afterwards.)"));
  return command;
}

}  // namespace haff::campaign
