#include "campaign/commands/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <string_view>

#include "campaign/base/output/output.hpp"
#include "campaign/base/process/exit_code.hpp"
#include "campaign/base/process/machine.hpp"
#include "campaign/base/process/version.hpp"
#include "campaign/base/text/command_text.hpp"
#include "campaign/base/text/duration.hpp"
#include "campaign/base/text/number_text.hpp"
#include "campaign/commands/documents.hpp"
#include "campaign/commands/json_output.hpp"
#include "campaign/commands/store/recompute.hpp"

namespace haff::campaign {
namespace {

constexpr int most_workers = 1024;
constexpr int most_rounds = 1000;
constexpr int default_rounds = 20;
constexpr double default_put_back_every = 600;  // [s]
constexpr int most_threads = 64;                // of a worker
constexpr int most_shards = 100'000;
constexpr double default_watch_every = 2;  // [s]
constexpr double least_watch_every = 0.1;  // [s]
constexpr int most_ports = 65'535;

constexpr const char* exit_codes = R"(Exit codes:
  0  complete
  1  a job failed, a target cannot be met, the store is damaged or cannot be read or written
  2  bad input: grid, command line, the name of the store, or SQL
  3  stopped by --max-time or --budget with work left
  128 + signal  interrupted; the same command goes on)";

std::string examples(const char* text) {
  return fmt::format(
      "Examples:\n{}\n\n--store FILE (default {}), --verbose and --json may stand before or "
      "after a command.",
      text, default_store);
}

CLI::App* add_plan(CLI::App& app, PlanOptions& options) {
  auto* command = app.add_subcommand("plan", "Make jobs out of a grid of (e, n, N, seed)");
  command->add_option("GRID", options.grid, "The grid, a JSON file")->type_name("FILE")->required();
  command->add_flag("--dry-run", options.dry_run, "Show what would be added; write nothing");
  command->footer(examples(R"(  campaign plan grid.json
  campaign plan grid.json --dry-run
  campaign plan grid.json --store /data/dense.db

A grid, with its defaults from "sample_every" on:
  { "e": [0.80, 0.90], "n": 0.4, "N": 32000, "seeds": 2,
    "tau_max": {"0.80": 90, "0.90": 180},
    "sample_every": 1, "equilibrate": 50, "checkpoint_every": 10,
    "observables": ["temperature", "laguerre"] }

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
                   "Threads of each worker; every number gives the same rows. Two make a gas of "
                   "500000 particles or more 1.5 times as fast; seeds side by side gain more")
      ->check(CLI::Range(1, most_threads))
      ->type_name("T")
      ->capture_default_str();
  command->callback([&options, workers] {
    if (workers->count() == 0) options.workers = std::max(1, processors() / options.threads);
  });
  const auto set_max_time = [&options](const std::string& text) {
    options.max_seconds = seconds_from_text(text);
    if (!options.max_seconds)
      throw CLI::ValidationError("--max-time",
                                 "'" + text + "' is no duration; expected e.g. 90s, 45m or 1h30m");
  };
  command
      ->add_option_function<std::string>("--max-time", set_max_time,
                                         "Stop after this time: 90s, 45m, 1h30m; take no job of "
                                         "which nothing could be stored by then")
      ->type_name("TIME");
  const auto set_budget = [&options](const std::string& text) {
    options.cpu_budget = seconds_from_text(text);
    if (!options.cpu_budget)
      throw CLI::ValidationError("--budget",
                                 "'" + text + "' is no duration; expected e.g. 90s, 45m or 1h30m");
  };
  command
      ->add_option_function<std::string>("--budget", set_budget,
                                         "Spend at most this CPU time, all workers together")
      ->type_name("TIME");
  command
      ->add_option("--log-json", options.log_json,
                   "Append what happens to this file, a line of JSON an event")
      ->type_name("FILE");
  command
      ->add_option("--on-finish", options.on_finish,
                   "Give this command to the shell when the run ends, however it ends")
      ->type_name("COMMAND");
  command->footer(examples(R"(  campaign run
  campaign run --workers 4
  campaign run --max-time 1h30m     exit code 3 if work is left
  campaign run --budget 2h          of CPU time; targets not met by then: exit code 3
  campaign run 2> run.log &         plain lines of progress in run.log
  campaign run --log-json run.jsonl --on-finish 'mail -s "exit $CAMPAIGN_EXIT_CODE" me < /dev/null'

The command of --on-finish finds CAMPAIGN_EXIT_CODE, CAMPAIGN_DONE, CAMPAIGN_FAILED and
CAMPAIGN_PENDING (jobs of the whole store) and CAMPAIGN_STORE in its environment. The run's exit code
stays its own.
Ctrl-C stores what can be stored and leaves; the same command goes on.)"));
  return command;
}

CLI::App* add_status(CLI::App& app, StatusOptions& options) {
  auto* command = app.add_subcommand("status", "Jobs, progress, tau_c so far, failures");
  const auto set_watch = [&options](const std::string& text) {
    options.watch_every = text.empty() ? default_watch_every : seconds_from_text(text).value_or(0);
    if (!(*options.watch_every >= least_watch_every))
      throw CLI::ValidationError(
          "--watch", "'" + text + "' is no duration of 0.1 s or more; expected e.g. 5s or 1m");
  };
  command
      ->add_option_function<std::string>("--watch", set_watch,
                                         "Again every so often, 2 s if no time is given, until "
                                         "Ctrl-C")
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
      "explain", "Why a job is where it is: what it waits for, what was tried, what comes next");
  command->add_option("JOB", options.job_id, "The job_id, as in the table jobs")
      ->type_name("NUMBER")
      ->required();
  command->footer(examples(R"(  campaign explain 7
  campaign explain 7 --json
  campaign query "SELECT job_id, kind, e, n, particles, seed, status FROM jobs")"));
  return command;
}

void add_format(CLI::App& command, RowFormat& format) {
  const auto set_format = [&format](const std::string& name) {
    format = name == "csv" ? RowFormat::csv : name == "json" ? RowFormat::json : RowFormat::table;
  };
  command.add_option_function<std::string>("--format", set_format, "How to print the rows")
      ->check(CLI::IsMember({"table", "csv", "json"}))
      ->type_name("table|csv|json")
      ->default_str("table");
}

CLI::App* add_query(CLI::App& app, QueryCommand& options) {
  auto* command = app.add_subcommand("query", "Ask the store one question in SQL");
  command->add_option("SQL", options.sql, "One statement that reads")
      ->type_name("TEXT")
      ->required();
  add_format(*command, options.format);
  command->footer(
      examples(R"(  campaign query "SELECT e, n, particles, tau_c, tau_c_se FROM mean_tau_c"
  campaign query "SELECT tau, a2, a2_se FROM mean_series WHERE e = 0.9" --format csv > a2.csv
  campaign query "SELECT * FROM jobs" --format json)"));
  return command;
}

CLI::App* add_figures(CLI::App& app, FigureRequest& options) {
  auto* command =
      app.add_subcommand("figures", "Draw the paper's figures and those of all gases, and a page");
  command->add_option("--out", options.out, "Folder to write to")
      ->type_name("DIR")
      ->capture_default_str();
  const auto set_only = [&options](const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      const auto number = number_in(name);
      if (number && *number == static_cast<int>(*number))
        options.only.push_back(static_cast<int>(*number));
      else
        options.gases.push_back(name);
    }
  };
  command
      ->add_option_function<std::vector<std::string>>(
          "--only", set_only, "Numbers of the paper's figures and names of others, e.g. 1,2,energy")
      ->type_name("LIST")
      ->delimiter(',');
  command->footer(examples(R"(  campaign figures
  campaign figures --out paper --only 1,2,11
  campaign figures --only energy,a2,pressure

The paper's figures, where the store has its gases, and figures of all the gases that it has; each as
CSV, SVG and PNG, and all on one page. `campaign plot` draws other questions.)"));
  return command;
}

CLI::App* add_plot(CLI::App& app, PlotOptions& options) {
  Question& question = options.question;
  auto* command = app.add_subcommand("plot", "Draw a question of your own: this against that");
  command
      ->add_option("Y", question.y,
                   "A column, a profile, a quantity, or an SQL expression in columns; --list names "
                   "them")
      ->type_name("NAME");
  command
      ->add_option("--against", question.against,
                   "tau, time, a parameter (e, n, N, roughness.beta), a profile's variable, or an "
                   "expression")
      ->type_name("NAME");
  command
      ->add_option("--by", question.by,
                   "Parameters that colours and legend go by; by default all that vary")
      ->type_name("LIST")
      ->delimiter(',');
  command
      ->add_option("--where", question.where,
                   "Which gases and samples, a condition in SQL: \"e < 0.9 AND N = 8000\"")
      ->type_name("SQL");
  const auto set_log = [&question](const std::vector<std::string>& axes) {
    question.log_x = std::ranges::count(axes, "x") > 0;
    question.log_y = std::ranges::count(axes, "y") > 0;
  };
  command
      ->add_option_function<std::vector<std::string>>("--log", set_log,
                                                      "Logarithmic axes: x, y or x,y")
      ->check(CLI::IsMember({"x", "y"}))
      ->type_name("AXES")
      ->delimiter(',');
  command->add_flag("--theory", question.theory, "With the theory that is known of it");
  const auto set_difference = [&question](const std::string& text) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
      throw CLI::ValidationError(
          "--difference", "'" + text + "' is no reference; expected e.g. e=0.9 or roughness=none");
    question.difference = {text.substr(0, equals), text.substr(equals + 1)};
  };
  command
      ->add_option_function<std::string>("--difference", set_difference,
                                         "Subtract, seed by seed, the gas with this value: e=0.9; "
                                         "without an effect: roughness=none")
      ->type_name("PARAMETER=VALUE");
  const auto set_out = [&options](const std::string& text) {
    options.out = text;
    if (!is_plot_file(*options.out))
      throw CLI::ValidationError("--out",
                                 "'" + text + "': expected a name that ends in .svg, .png or .csv");
  };
  command
      ->add_option_function<std::string>("--out", set_out,
                                         "Picture or table, by its suffix .svg, .png or .csv; "
                                         "without, the picture is printed as text")
      ->type_name("FILE");
  command->add_flag("--list", options.list, "What the store has to be drawn");
  command->footer(examples(R"(  campaign plot --list
  campaign plot a2 --against tau --by e --theory
  campaign plot energy --log y --by n --where "d = 3 AND N = 8000" --out energy.svg
  campaign plot a2 --against roughness.beta --by n          the mean over tau 5 to 15
  campaign plot pressure@20 --against n --by e --theory --out pressure.csv
  campaign plot tau_c --against N --by e --log x
  campaign plot G_parallel --against r --where "tau = 50"
  campaign plot "temperature_1/temperature_2" --against tau --by mixture.mass_ratio
  campaign plot gamma_ratio --against tau --difference e=0.9 --out difference.png

A curve is the mean over realizations of one gas, with the 68 % interval of the mean by Student's t;
gases that differ are never averaged. In --where, N is the number of particles and roughness.beta
the effect's parameter; tau thins samples too ("tau % 5 = 0").

Exit code 1 if no finished run has what is asked for, 2 if a name or the SQL is not known.)"));
  return command;
}

CLI::App* add_export(CLI::App& app, ExportCommand& options) {
  auto* command =
      app.add_subcommand("export", "Print a job's last stored state as extended XYZ, for OVITO");
  command->add_option("JOB", options.job_id, "The job_id, as in the table jobs")
      ->type_name("NUMBER")
      ->required();
  command->footer(
      examples(R"(  campaign query "SELECT job_id, kind, e, n, particles, seed, tau FROM jobs"
  campaign export 3 > job-3.xyz     open it in OVITO: particles, box, velocities
  campaign export 3 | gzip > job-3.xyz.gz

What is stored is the newest checkpoint; its tau stands in the second line.)"));
  return command;
}

CLI::App* add_cost(CLI::App& app, CostRequest& options) {
  auto* command = app.add_subcommand("cost", "What accuracy costs in time");
  command->add_option("--out", options.out, "Folder to write to")
      ->type_name("DIR")
      ->capture_default_str();
  const auto set_target = [&options](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) {
      const auto target = target_from_text(text);
      if (!target)
        throw CLI::ValidationError("--target",
                                   "'" + text +
                                       "' is no target; expected a quantity and an error above 0, "
                                       "e.g. a2=5e-4, over a window of tau a2@3:8=5e-4, at one "
                                       "tau gamma_ratio@20=1e-3; quantities: a2, a3, a4, "
                                       "gamma_ratio, ln_temperature, tau_c, G_parallel");
      options.targets.push_back(*target);
    }
  };
  command
      ->add_option_function<std::vector<std::string>>("--target", set_target,
                                                      "The error to advise on, e.g. a2=5e-4; of "
                                                      "other tau than usual a2@3:8=5e-4")
      ->type_name("QUANTITY[@TAU]=ERROR")
      ->delimiter(',');
  command->footer(examples(R"(  campaign cost
  campaign cost --target a2=5e-4,tau_c=0.5
  campaign cost --target a2@3:8=5e-4,gamma_ratio@20=1e-3,ln_temperature@50=0.01
  campaign cost --out accuracy

TAU is a window FROM:TO (a2, a3, a4, gamma_ratio), or one tau (gamma_ratio: 2 to either side,
ln_temperature, G_parallel). Quantities that a grid has a "target" for are in the table too.

Exit code 1 if no cooling run is done: it then says what to plan.)"));
  return command;
}

CLI::App* add_report(CLI::App& app, ReportOptions& options) {
  auto* command = app.add_subcommand("report", "The store as a page to look at, in one file");
  command->add_option("--out", options.out, "Folder to write report.html to")
      ->type_name("DIR")
      ->capture_default_str();
  const auto set_port = [&options](const std::string& text) {
    options.serve = true;
    if (text.empty()) return;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), options.port);
    if (error != std::errc() || end != text.data() + text.size() || options.port < 1 ||
        options.port > most_ports)
      throw CLI::ValidationError("--serve", "'" + text + "' is no port; expected 1 to 65535");
  };
  command
      ->add_option_function<std::string>("--serve", set_port,
                                         "Serve the page on 127.0.0.1 instead, refreshed while a "
                                         "run is on, until Ctrl-C; any port that is free unless "
                                         "one is named")
      ->expected(0, 1)
      ->type_name("[PORT]")
      ->excludes("--out");
  command->footer(examples(R"(  campaign report                  writes report/report.html
  campaign report --out /tmp       open it in any browser, or mail it: it needs no network
  campaign report --serve          prints an address for a browser on this machine
  campaign report --serve 8080     from another machine: ssh -L 8080:127.0.0.1:8080 HOST

Only this machine can ask the server, and only with the token in the address that is printed. It
never writes the store.)"));
  return command;
}

CLI::App* add_verify(CLI::App& app, VerifyOptions& options) {
  auto* command = app.add_subcommand(
      "verify", "Check the store: SQLite, digests of rows, checkpoints, physics, completeness");
  auto* repair =
      command->add_flag("--repair", options.repair,
                        "Compute again what is wrong, and put the rows right where they differ");
  command
      ->add_option("--recompute", options.recompute,
                   "Compute finished jobs again and compare every bit: a job's number, all, or a "
                   "part of them such as 5%")
      ->type_name("JOB|all|N%")
      ->check(CLI::Validator([](std::string& word) { return fault_of_choice(word); }, ""))
      ->excludes(repair);
  command->footer(examples(R"(  campaign verify && echo sound
  campaign verify --recompute 12
  campaign verify --recompute 5% --store dense.db
  campaign verify --repair && campaign run

Exit code 1: something is wrong. Each row has a digest since it was written, so that any bit that has
flipped since is found. --recompute costs the CPU time of the jobs, and finds what was wrong when it
was written; it changes nothing. --repair changes only what is wrong, and says what it changed.)"));
  return command;
}

CLI::App* add_retry(CLI::App& app) {
  auto* command = app.add_subcommand(
      "retry", "Reopen failed jobs and those whose checkpoint or rows are damaged");
  command->footer(examples("  campaign retry && campaign run"));
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

CLI::App* add_upgrade(CLI::App& app) {
  auto* command =
      app.add_subcommand("upgrade", "Bring a store of an older version of this program forward");
  command->footer(examples(R"(  campaign backup before.db && campaign upgrade

An older store can be read as it is; to plan and run in it takes this command, while nothing runs.
It is one transaction: cut off, it has changed nothing. Older programs cannot use the store after
it.)"));
  return command;
}

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

In any order, as often as you like, of shards that have not ended, and while a run is on: rows that
are here already are compared, in every bit, and the others are added. Exit code 1 if a shard is
refused: it is of another campaign, damaged, or contradicts what is known.)"));
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

// A duration given as text.
CLI::Option* add_duration(CLI::App* command, const std::string& name, double& seconds,
                          const std::string& what) {
  const auto set = [&seconds, name](const std::string& text) {
    const auto value = seconds_from_text(text);
    if (!value)
      throw CLI::ValidationError(name,
                                 "'" + text + "' is no duration; expected e.g. 90s, 45m or 1h30m");
    seconds = *value;
  };
  return command->add_option_function<std::string>(name, set, what)->type_name("TIME");
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
  command->add_option("--rounds", cluster.rounds, "Rounds at most: what is left is submitted again")
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
  command->add_option("--round", options.round)->group("");  // what the job after a round gives
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
  const auto set_max_time = [&options](const std::string& text) {
    options.max_seconds = seconds_from_text(text);
    if (!options.max_seconds)
      throw CLI::ValidationError("--max-time",
                                 "'" + text + "' is no duration; expected e.g. 90s, 45m or 1h30m");
  };
  command
      ->add_option_function<std::string>("--max-time", set_max_time,
                                         "Stop computing after this time")
      ->type_name("TIME");
  add_duration(command, "--put-back-every", options.put_back_every, "How often the shard is saved")
      ->default_str("10m");
  command->footer(examples(R"(  campaign task --workers 8 --max-time 3h50m shards/shard-001.db

The shard is copied to $SLURM_TMPDIR, $TMPDIR or /tmp, run there, and put back by copying and
renaming, from time to time and at the end; signals stop it in order.)"));
  return command;
}

CLI::App* add_theory(CLI::App& app, TheoryOptions& options) {
  auto* command = app.add_subcommand("theory", "Print a theory curve: table, CSV or JSON");
  command->add_option("CURVE", options.curve, "Which one; --list names them")->type_name("NAME");
  command->add_flag("--list", options.list, "The curves, what they are functions of");
  command->add_option("--d", options.d, "Dimension")
      ->check(CLI::IsMember({2, 3}))
      ->type_name("2|3")
      ->capture_default_str();
  const auto add_values = [command](const char* name, std::vector<double>& values,
                                    const char* what) {
    const auto set = [name, &values](const std::string& text) {
      const auto read = values_from_text(text);
      if (!read)
        throw CLI::ValidationError(name,
                                   "'" + text + "' is no number, list 1,2,5 or range FROM:TO:STEP");
      values = *read;
    };
    command->add_option_function<std::string>(name, set, what)->type_name("VALUES");
  };
  add_values("--e", options.e, "Restitution coefficient (0.85)");
  add_values("--n", options.n, "Number density [sigma^-d] (0.4)");
  add_values("--tau", options.tau, "Collisions per particle (0:40:1; of curves in r 50)");
  add_values("--r", options.r, "Distances [sigma] (1:20:0.5)");
  add_values("--k", options.k, "Wave numbers [1/sigma] (0.02:1:0.02)");
  command->add_option("--b", options.b, "Cutoff number of the energy equation")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command
      ->add_option("--effects", options.effects, "As in a grid: restitution, thermostat, shuffle")
      ->type_name("JSON")
      ->capture_default_str();
  command->add_option("--particles", options.particles, "Of a direct simulation computed now")
      ->check(CLI::Range(2, 100'000'000))
      ->capture_default_str();
  command->add_option("--realizations", options.realizations, "Likewise; errors fall with its root")
      ->check(CLI::Range(2, 1'000'000))
      ->capture_default_str();
  command->add_option("--seed", options.seed, "Likewise")->capture_default_str();
  add_format(*command, options.format);
  command->footer(R"(Examples:
  campaign theory --list
  campaign theory a2 --d 3 --e 0.85 --tau 0:40:1 --format csv
  campaign theory gamma_ratio --e 0.9 --n 0.4 --tau 0:100:5
  campaign theory tau_c --e 0.80,0.85,0.90,0.95
  campaign theory G_parallel --e 0.8 --tau 50 --r 2:30:0.5
  campaign theory a2 --e 0.77 --realizations 64
  campaign theory temperature --effects '{"restitution": {"law": "viscoelastic", "A": 0.05}}'

VALUES are a number, a list 1,2,5 or a range FROM:TO:STEP. Columns:
  second_order      Enskog-Boltzmann theory to first order in a_2 (its plateau is -A/B)
  dsmc, dsmc_se     the Enskog-Boltzmann equation itself by direct simulation, and its standard
                    error: from a table at e = 0.7, 0.8, 0.85, 0.865, 0.9, 0.95, 0.98, 1, else
                    computed now (--particles, --realizations; some ten seconds)
  energy_equation   with velocity correlations; non_gaussian: a_2 taken into account as well
No store is read. A shuffle changes nothing in a homogeneous gas: its theory is that without.)");
  return command;
}

CLI::App* add_worker(CLI::App& app, WorkerCommand& options) {
  auto* command = app.add_subcommand("worker", "")->group("");  // not shown
  command->add_option("DESCRIPTOR", options.report_descriptor)->required();
  command->add_option("--until", options.until);
  command->add_option("--threads", options.threads)->check(CLI::Range(1, most_threads));
  return command;
}

CLI::App* add_document(CLI::App& app, std::string& kind) {
  auto* command = app.add_subcommand("document", "")->group("");  // for `cmake --install`
  command->add_option("KIND", kind)
      ->required()
      ->check(CLI::IsMember(
          std::vector<std::string>(std::begin(document_kinds), std::end(document_kinds))));
  return command;
}

// Those that print a table or the like, and print JSON when asked.
constexpr std::string_view with_json[] = {"plan",  "run",    "status", "explain",
                                          "query", "theory", "verify", "retry",
                                          "split", "merge",  "recall", "cost"};

std::string names_with_json() {
  return fmt::format("{}", fmt::join(with_json, ", "));
}

// A program that reads the output of a command must not be given a table.
void refuse_json_for(const CLI::App& app) {
  const auto commands = app.get_subcommands();
  if (commands.empty()) return;
  const std::string name = commands.front()->get_name();
  if (std::ranges::find(with_json, name) == std::end(with_json))
    throw CLI::ValidationError("--json",
                               fmt::format("{} prints no JSON; {} do", name, names_with_json()));
}

// Before the command line is understood: whether its errors are for a program.
bool asks_for_json(int argc, const char* const* argv) {
  return std::any_of(argv + 1, argv + argc,
                     [](const char* word) { return std::string_view(word) == "--json"; });
}

std::string names(const CLI::App& app) {
  std::string list;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    if (!command->get_group().empty()) list += (list.empty() ? "" : ", ") + command->get_name();
  return list;
}

std::string complaint(const CLI::App* app, const CLI::Error& error) {
  std::string name = "campaign";
  const auto commands = app->get_subcommands();
  if (!commands.empty()) name += ' ' + commands.front()->get_name();
  return fmt::format("campaign: {}\nSee: {} --help\n", error.what(), name);
}

}  // namespace

Parsed parse_command_line(int argc, const char* const* argv) {
  CLI::App app(
      "Campaigns of event-driven simulations of the freely cooling gas of inelastic hard spheres.");
  app.name("campaign");
  app.set_version_flag("--version", version_text(), "Print version, commit, compiler and SIMD");
  app.require_subcommand(0, 1);
  app.fallthrough();
  app.failure_message(complaint);
  app.footer(examples(R"(  campaign plan examples/first.json   make jobs out of a grid
  campaign run                        run them, on all processors
  campaign status                     see how far they are
  campaign figures                    draw the paper's figures
  campaign run --help                 more about one command)") +
             "\n\n" + exit_codes);

  CommandLine line;
  std::string store = default_store;
  app.add_option("--store", store, "The SQLite file of the campaign")
      ->type_name("FILE")
      ->capture_default_str();
  app.add_flag("--verbose", line.verbose, "Log more to stderr");
  app.add_flag("--json", line.json,
               "Print JSON instead of tables, and errors as JSON on stderr: " + names_with_json());

  PlanOptions plan;
  RunOptions run;
  StatusOptions status;
  ExplainCommand explained;
  QueryCommand query;
  FigureRequest figures;
  PlotOptions plotted;
  ExportCommand exported;
  CostRequest cost;
  VerifyOptions verify;
  BackupCommand backup;
  SplitOptions split;
  MergeOptions merge;
  RecallOptions recall;
  SubmitOptions submit;
  TaskOptions task;
  TheoryOptions theory;
  ReportOptions report;
  WorkerCommand worker;
  const CLI::App* plan_command = add_plan(app, plan);
  const CLI::App* run_command = add_run(app, run);
  const CLI::App* status_command = add_status(app, status);
  const CLI::App* explain_command = add_explain(app, explained);
  const CLI::App* query_command = add_query(app, query);
  const CLI::App* figures_command = add_figures(app, figures);
  const CLI::App* plot_command = add_plot(app, plotted);
  const CLI::App* export_command = add_export(app, exported);
  const CLI::App* cost_command = add_cost(app, cost);
  const CLI::App* verify_command = add_verify(app, verify);
  const CLI::App* retry_command = add_retry(app);
  const CLI::App* backup_command = add_backup(app, backup);
  const CLI::App* upgrade_command = add_upgrade(app);
  const CLI::App* split_command = add_split(app, split);
  const CLI::App* merge_command = add_merge(app, merge);
  const CLI::App* recall_command = add_recall(app, recall);
  const CLI::App* submit_command = add_submit(app, submit);
  const CLI::App* task_command = add_task(app, task);
  const CLI::App* theory_command = add_theory(app, theory);
  const CLI::App* report_command = add_report(app, report);
  const CLI::App* worker_command = add_worker(app, worker);
  std::string kind;
  const CLI::App* document_command = add_document(app, kind);

  try {
    app.parse(argc, argv);
    if (app.get_subcommands().empty())
      throw CLI::RequiredError("no command; expected one of " + names(app),
                               CLI::ExitCodes::RequiredError);
    if (line.json) refuse_json_for(app);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0 && asks_for_json(argc, argv)) {
      complain_lines(error_json(error.what(), exit_bad_input));
      return exit_bad_input;
    }
    return app.exit(error) == 0 ? exit_complete : exit_bad_input;
  }

  if (document_command->parsed()) {
    fmt::print("{}", document(app, kind));
    return exit_complete;
  }

  plan.json = cost.json = run.json = status.json = split.json = merge.json = recall.json =
      line.json;
  if (line.json) query.format = theory.format = RowFormat::json;
  line.store = plan.store = run.store = split.store = merge.store = recall.store =
      submit.cluster.store = report.store = status.store = verify.store = store;
  verify.json = line.json;
  if (plan_command->parsed()) line.command = plan;
  if (run_command->parsed()) line.command = run;
  if (status_command->parsed()) line.command = status;
  if (explain_command->parsed()) line.command = explained;
  if (query_command->parsed()) line.command = query;
  if (figures_command->parsed()) line.command = figures;
  if (plot_command->parsed()) line.command = plotted;
  if (export_command->parsed()) line.command = exported;
  if (cost_command->parsed()) line.command = cost;
  if (verify_command->parsed()) line.command = verify;
  if (retry_command->parsed()) line.command = RetryCommand{};
  if (backup_command->parsed()) line.command = backup;
  if (upgrade_command->parsed()) line.command = UpgradeCommand{};
  if (split_command->parsed()) line.command = split;
  if (merge_command->parsed()) line.command = merge;
  if (recall_command->parsed()) line.command = recall;
  if (submit_command->parsed()) line.command = submit;
  if (task_command->parsed()) line.command = task;
  if (theory_command->parsed()) line.command = theory;
  if (report_command->parsed()) line.command = report;
  if (worker_command->parsed()) line.command = worker;
  return line;
}

}  // namespace haff::campaign
