#include "campaign/commands/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

#include "campaign/base/output/output.hpp"
#include "campaign/base/process/exit_code.hpp"
#include "campaign/base/process/version.hpp"
#include "campaign/base/text/command_text.hpp"
#include "campaign/commands/documents.hpp"
#include "campaign/commands/json_output.hpp"
#include "campaign/commands/options.hpp"

namespace haff::campaign {
namespace {

constexpr const char* exit_codes = R"(Exit codes:
  0  complete
  1  a job failed, a target cannot be met, the store is damaged or cannot be read or written
  2  bad input: grid, command line, the name of the store, or SQL
  3  stopped by --max-time or --budget with work left
  128 + signal  interrupted; the same command goes on)";

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

std::string examples(const char* text) {
  return fmt::format(
      "Examples:\n{}\n\n--store FILE (default {}), --verbose and --json may stand before or "
      "after a command.",
      text, default_store);
}

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
