// SPDX-License-Identifier: GPL-3.0-or-later

// The command line: which command was given, with which options.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>

#include "campaign/accuracy/cost/cost.hpp"
#include "campaign/commands/cluster/merge.hpp"
#include "campaign/commands/cluster/recall.hpp"
#include "campaign/commands/cluster/split.hpp"
#include "campaign/commands/cluster/submit.hpp"
#include "campaign/commands/results/export.hpp"
#include "campaign/commands/results/plot.hpp"
#include "campaign/commands/results/query.hpp"
#include "campaign/commands/results/report.hpp"
#include "campaign/commands/results/theory.hpp"
#include "campaign/commands/run/plan.hpp"
#include "campaign/commands/run/run.hpp"
#include "campaign/commands/run/status.hpp"
#include "campaign/commands/store/cancel.hpp"
#include "campaign/commands/store/verify.hpp"
#include "campaign/figures/figures.hpp"
#include "campaign/job/thread_share.hpp"

namespace haff::campaign {

struct ExplainCommand {
  std::int64_t job_id = 0;
};
struct QueryCommand {
  std::string sql;
  RowFormat format = RowFormat::table;
};
struct RetryCommand {};
struct BackupCommand {
  std::filesystem::path to;
};
struct UpgradeCommand {};
struct WorkerCommand {  // what `run` starts; not for people
  int report_descriptor = 0;
  ThreadShare share;
  std::optional<double> until;  // on the monotonic clock [s]
  std::string where, order;
};

using Command = std::variant<PlanOptions, RunOptions, StatusOptions, ExplainCommand, QueryCommand,
                             FigureRequest, PlotOptions, CostRequest, ExportOptions, VerifyOptions,
                             RetryCommand, CancelOptions, BackupCommand, UpgradeCommand,
                             SplitOptions, MergeOptions, RecallOptions, SubmitOptions, TaskOptions,
                             TheoryOptions, ReportOptions, WorkerCommand>;

struct CommandLine {
  std::filesystem::path store;
  bool verbose = false;
  bool json = false;  // output and errors are for programs
  Command command;
};

// The exit code if there is nothing more to do: help or version printed, or an error reported.
using Parsed = std::variant<CommandLine, int>;
Parsed parse_command_line(int argc, const char* const* argv);

}  // namespace haff::campaign
