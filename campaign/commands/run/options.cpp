// SPDX-License-Identifier: GPL-3.0-or-later

// The options of plan, run, status, explain, and the worker that run starts.
#include "campaign/commands/options.hpp"

#include <algorithm>

#include "campaign/base/process/machine.hpp"
#include "campaign/base/text/duration.hpp"

namespace haff::campaign {

namespace {

constexpr double default_watch_every = 2;  // [s]
constexpr double least_watch_every = 0.1;  // [s]

}  // namespace

CLI::App* add_plan(CLI::App& app, PlanOptions& options) {
  auto* command = app.add_subcommand("plan", "Make jobs out of a grid of (e, n, N, seed)");
  command->add_option("GRID", options.grid, "The grid, a JSON file")->type_name("FILE")->required();
  command->add_flag("--dry-run", options.dry_run, "Show what would be added; write nothing");
  command->add_flag("--replace", options.replace,
                    "The grid takes the place of what is planned: jobs that it does not have go "
                    "unless they were begun, and a smaller tau_max counts");
  command->footer(examples(R"(  campaign plan grid.json
  campaign plan grid.json --dry-run
  campaign plan grid.json --store /data/dense.db
  campaign plan grid.json --replace --dry-run    what would go, end earlier and stay

A grid, with its defaults from "sample_every" on:
  { "e": [0.80, 0.90], "n": 0.4, "N": 32000, "seeds": 2,
    "tau_max": {"0.80": 90, "0.90": 180},
    "sample_every": 1, "equilibrate": 50, "checkpoint_every": 10,
    "observables": ["temperature", "laguerre"] }

Further samples, 20 a decade of tau, and the whole gas at three of them, for export:
  { "e": 0.9, "n": 0.4, "N": 32000, "seeds": 2, "tau_max": 180,
    "sample_at": {"log": 20}, "snapshots_at": [1, 10, 100] }

Other starts than the equilibrated gas, a series each; the last is what `export` has written:
  { "e": 0.9, "n": 0.4, "N": 32000, "seeds": 1, "tau_max": 50,
    "start": ["crystal", "shear wave", "two temperatures", {"file": "gas.xyz"}] }

A standard error instead of a number of seeds; those given are pilot runs, `run` adds to them:
  { "e": 0.9, "n": 0.4, "N": 8000, "seeds": 5, "tau_max": 15,
    "target": {"a2": {"tau": [5, 15], "se": 1e-3}} })"));
  return command;
}

CLI::App* add_run(CLI::App& app, RunOptions& options) {
  options.workers = processors();
  auto* command = app.add_subcommand("run", "Run all that is pending, equilibrations first");
  const auto* workers =
      command
          ->add_option("--workers", options.workers,
                       "Worker processes, one job each at a time; by default one for every "
                       "--threads processors")
          ->check(CLI::Range(1, most_workers))
          ->type_name("K")
          ->capture_default_str();
  command
      ->add_option("--threads", options.threads,
                   "Threads of each worker; every number gives the same rows. By default one, and "
                   "more for a job of 100000 particles or more whenever fewer jobs are left than "
                   "workers")
      ->check(CLI::Range(1, most_threads))
      ->type_name("T");
  command->callback([&options, workers] {
    if (workers->count() == 0 && options.threads > 0)
      options.workers = std::max(1, processors() / options.threads);
  });
  add_duration(
      command, "--max-time", options.max_seconds,
      "Stop after this time: 90s, 45m, 1h30m; a job that could store nothing by then is not begun");
  add_duration(command, "--budget", options.cpu_budget,
               "Spend at most this CPU time, all workers together");
  add_where(
      command, options.where,
      "Only jobs for which this condition holds, and the equilibrations that they start from");
  command
      ->add_option("--order", options.order,
                   "Take jobs in this order, terms in SQL: \"seed, e DESC\"")
      ->check(CLI::Validator(not_empty, ""))
      ->type_name("SQL");
  command
      ->add_option("--log-json", options.log_json,
                   "Append to this file one line of JSON for each event")
      ->type_name("FILE");
  command
      ->add_option("--on-finish", options.on_finish,
                   "Give this command to the shell when the run ends, however it ends")
      ->type_name("COMMAND");
  command->footer(examples(R"(  campaign run
  campaign run --workers 4
  campaign run --max-time 1h30m     exit code 3 if work is left
  campaign run --budget 2h          of CPU time; targets not met by then: exit code 3
  campaign run --where "e = 0.9 AND N < 10000"
  campaign run --where "roughness.beta IS NULL" --order "seed, N DESC"
  campaign run 2> run.log &         plain lines of progress in run.log
  campaign run --log-json run.jsonl --on-finish 'mail -s "exit $CAMPAIGN_EXIT_CODE" me < /dev/null'

--where and --order are SQL in the columns of the table jobs, with N for the number of particles and
roughness.beta for the parameter of an effect. A condition chooses cooling jobs; equilibrations are run
when a chosen job waits for them, and are chosen themselves if the condition names kind or job_id.
Without --order the longest jobs come first, so that no worker is left alone with one at the end.

The command of --on-finish finds CAMPAIGN_EXIT_CODE, CAMPAIGN_DONE, CAMPAIGN_FAILED and
CAMPAIGN_PENDING (jobs of the whole store) and CAMPAIGN_STORE in its environment. The run's exit code
stays its own.
Ctrl-C stores what can be stored and leaves; the same command goes on.)"));
  return command;
}

CLI::App* add_status(CLI::App& app, StatusOptions& options) {
  auto* command = app.add_subcommand("status", "Show jobs, progress, tau_c so far and failures");
  const auto set_watch = [&options](const std::string& text) {
    options.watch_every = text.empty() ? default_watch_every : seconds_from_text(text).value_or(0);
    if (!(*options.watch_every >= least_watch_every))
      throw CLI::ValidationError(
          "--watch", "'" + text + "' is no duration of 0.1 s or more; expected e.g. 5s or 1m");
  };
  command
      ->add_option_function<std::string>(
          "--watch", set_watch,
          "Print it again and again, every 2 s unless a time is given, until Ctrl-C")
      ->expected(0, 1)
      ->type_name("[TIME]");
  command->footer(examples(R"(  campaign status
  campaign status --json | jq .fraction_done
  campaign status --watch           while a run is on
  campaign status --watch 1m --json >> status.jsonl   a line a minute)"));
  return command;
}

CLI::App* add_explain(CLI::App& app, ExplainCommand& options) {
  auto* command = app.add_subcommand(
      "explain", "Explain where a job stands: what it waits for, what was tried, what comes next");
  command->add_option("JOB", options.job_id, "The job_id, as in the table jobs")
      ->type_name("NUMBER")
      ->required();
  command->footer(examples(R"(  campaign explain 7
  campaign explain 7 --json
  campaign query "SELECT job_id, kind, e, n, particles, seed, status FROM jobs")"));
  return command;
}

CLI::App* add_worker(CLI::App& app, WorkerCommand& options) {
  auto* command = app.add_subcommand("worker", "")->group("");  // not shown
  command->add_option("DESCRIPTOR", options.report_descriptor)->required();
  command->add_option("--until", options.until);
  command->add_option("--threads", options.share.threads)->check(CLI::Range(0, most_threads));
  command->add_option("--processors", options.share.processors)->check(CLI::PositiveNumber);
  command->add_option("--where", options.where);
  command->add_option("--order", options.order);
  return command;
}

}  // namespace haff::campaign
