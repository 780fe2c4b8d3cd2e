// SPDX-License-Identifier: GPL-3.0-or-later

// The options of each command, and what several of them share.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "campaign/commands/command_line.hpp"

namespace haff::campaign {

inline constexpr int most_workers = 1024;
inline constexpr int most_threads = 64;  // of a worker

// The foot of a command's help.
std::string examples(const char* text);

// The value of an option that is a duration [s]. Throws CLI::ValidationError if the text is none.
double seconds_given(const std::string& option, const std::string& text);

// An option that is a duration: 90s, 45m or 1h30m. Seconds: double, or optional<double>.
template <class Seconds>
CLI::Option* add_duration(CLI::App* command, const std::string& name, Seconds& seconds,
                          const std::string& what) {
  const auto set = [&seconds, name](const std::string& text) {
    seconds = seconds_given(name, text);
  };
  return command->add_option_function<std::string>(name, set, what)->type_name("TIME");
}

// An option --where: a condition in SQL over the table jobs (schema/store/planning/choice.hpp).
CLI::Option* add_where(CLI::App* command, std::string& where, const std::string& what);

// The complaint about an empty text of an option that may not be empty: CLI11 takes it for one that
// was not given.
std::string not_empty(const std::string& text);

// run/options.cpp
CLI::App* add_plan(CLI::App& app, PlanOptions& options);
CLI::App* add_run(CLI::App& app, RunOptions& options);
CLI::App* add_status(CLI::App& app, StatusOptions& options);
CLI::App* add_explain(CLI::App& app, ExplainCommand& options);
CLI::App* add_worker(CLI::App& app, WorkerCommand& options);

// store/options.cpp
CLI::App* add_verify(CLI::App& app, VerifyOptions& options);
CLI::App* add_retry(CLI::App& app, RetryCommand& options);
CLI::App* add_cancel(CLI::App& app, CancelOptions& options);
CLI::App* add_backup(CLI::App& app, BackupCommand& options);
CLI::App* add_upgrade(CLI::App& app, UpgradeCommand& options);

// results/options.cpp
CLI::App* add_query(CLI::App& app, QueryCommand& options);
CLI::App* add_figures(CLI::App& app, FigureRequest& options);
CLI::App* add_plot(CLI::App& app, PlotOptions& options);
CLI::App* add_export(CLI::App& app, ExportOptions& options);
CLI::App* add_cost(CLI::App& app, CostRequest& options);
CLI::App* add_report(CLI::App& app, ReportOptions& options);
CLI::App* add_theory(CLI::App& app, TheoryOptions& options);

// cluster/options.cpp
CLI::App* add_split(CLI::App& app, SplitOptions& options);
CLI::App* add_merge(CLI::App& app, MergeOptions& options);
CLI::App* add_recall(CLI::App& app, RecallOptions& options);
CLI::App* add_submit(CLI::App& app, SubmitOptions& options);
CLI::App* add_task(CLI::App& app, TaskOptions& options);

}  // namespace haff::campaign
