// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/commands/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "campaign/base/output/output.hpp"
#include "campaign/base/process/exit_code.hpp"
#include "campaign/base/process/version.hpp"
#include "campaign/base/text/command_text.hpp"
#include "campaign/base/text/duration.hpp"
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

// The commands that print a table or the like, and print JSON when asked.
constexpr std::string_view with_json[] = {"plan",   "run",    "status", "explain",     "query",
                                          "theory", "verify", "retry",  "cancel",      "split",
                                          "merge",  "recall", "cost",   "plot --list", "export"};

std::string names_with_json() {
  return fmt::format("{}", fmt::join(with_json, ", "));
}

// A program that asks a command for JSON must not get a table.
void refuse_json_for(const CLI::App& app) {
  const auto commands = app.get_subcommands();
  if (commands.empty()) return;
  std::string name = commands.front()->get_name();
  if (name == "plot" && commands.front()->count("--list") > 0) name = "plot --list";
  if (std::ranges::find(with_json, name) == std::end(with_json))
    throw CLI::ValidationError("--json",
                               fmt::format("{} prints no JSON; {} do", name, names_with_json()));
}

// Whether errors in the command line are for a program, asked before the line is understood.
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

// The commands, each with its options. Which one was given is known when the line has been parsed.
class CommandsOffered {
 public:
  explicit CommandsOffered(CLI::App& app) : app_(app) {}

  template <class Options>
  void add(CLI::App* (*describe)(CLI::App&, Options&)) {
    const auto options = std::make_shared<Options>();
    const CLI::App* command = describe(app_, *options);
    offered_.push_back({command, [options] { return Command(*options); }});
  }

  Command given() const {
    for (const Offered& each : offered_)
      if (each.command->parsed()) return each.options();
    throw std::logic_error("no command was given");
  }

 private:
  struct Offered {
    const CLI::App* command;
    std::function<Command()> options;
  };
  CLI::App& app_;
  std::vector<Offered> offered_;
};

// Options that may stand before every command: which store, and whether output is JSON.
template <class Options>
void share(const CommandLine& line, Options& options) {
  if constexpr (requires { options.store; }) options.store = line.store;
  if constexpr (requires { options.cluster.store; }) options.cluster.store = line.store;
  if constexpr (requires { options.json; }) options.json = line.json;
  if constexpr (requires { options.format; })
    if (line.json) options.format = RowFormat::json;
}

}  // namespace

std::string examples(const char* text) {
  return fmt::format(
      "Examples:\n{}\n\n--store FILE (default {}), --verbose and --json may stand before or "
      "after a command.",
      text, default_store);
}

std::string not_empty(const std::string& text) {
  return text.find_first_not_of(" \t\n") == std::string::npos ? "is empty" : "";
}

CLI::Option* add_where(CLI::App* command, std::string& where, const std::string& what) {
  return command->add_option("--where", where, what)
      ->check(CLI::Validator(not_empty, ""))
      ->type_name("SQL");
}

double seconds_given(const std::string& option, const std::string& text) {
  if (const auto seconds = seconds_from_text(text)) return *seconds;
  throw CLI::ValidationError(option,
                             "'" + text + "' is no duration; expected e.g. 90s, 45m or 1h30m");
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

  CommandsOffered offered(app);
  offered.add(add_plan);
  offered.add(add_run);
  offered.add(add_status);
  offered.add(add_explain);
  offered.add(add_query);
  offered.add(add_figures);
  offered.add(add_plot);
  offered.add(add_export);
  offered.add(add_cost);
  offered.add(add_verify);
  offered.add(add_retry);
  offered.add(add_cancel);
  offered.add(add_backup);
  offered.add(add_upgrade);
  offered.add(add_split);
  offered.add(add_merge);
  offered.add(add_recall);
  offered.add(add_submit);
  offered.add(add_task);
  offered.add(add_theory);
  offered.add(add_report);
  offered.add(add_worker);
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

  line.store = store;
  line.command = offered.given();
  std::visit([&line](auto& options) { share(line, options); }, line.command);
  return line;
}

}  // namespace haff::campaign
