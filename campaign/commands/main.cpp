// SPDX-License-Identifier: GPL-3.0-or-later

// The program `campaign`. Results go to stdout; progress and logs to stderr.
#include <fmt/format.h>

#include <exception>
#include <iostream>
#include <new>
#include <stdexcept>

#include "campaign/accuracy/cost/cost.hpp"
#include "campaign/base/output/log.hpp"
#include "campaign/base/output/output.hpp"
#include "campaign/base/process/exit_code.hpp"
#include "campaign/base/process/signals.hpp"
#include "campaign/base/text/error_text.hpp"
#include "campaign/base/text/printable.hpp"
#include "campaign/commands/command_line.hpp"
#include "campaign/commands/json_output.hpp"
#include "campaign/commands/results/export.hpp"
#include "campaign/commands/results/plot.hpp"
#include "campaign/commands/results/query.hpp"
#include "campaign/commands/results/report.hpp"
#include "campaign/commands/results/theory.hpp"
#include "campaign/commands/run/explain.hpp"
#include "campaign/commands/run/plan.hpp"
#include "campaign/commands/run/run.hpp"
#include "campaign/commands/run/status.hpp"
#include "campaign/commands/store/backup.hpp"
#include "campaign/commands/store/cancel.hpp"
#include "campaign/commands/store/retry.hpp"
#include "campaign/commands/store/upgrade.hpp"
#include "campaign/commands/store/verify.hpp"
#include "campaign/curves/theory_point.hpp"
#include "campaign/figures/figures.hpp"
#include "campaign/run/host_lock.hpp"
#include "campaign/run/worker.hpp"
#include "schema/error.hpp"
#include "schema/grid/grid.hpp"

using namespace haff;
using namespace haff::campaign;

namespace {

// Carries out each command with its options, and returns its exit code.
struct CommandDispatcher {
  const CommandLine& line;

  int operator()(const PlanOptions& options) const {
    const HostLock lock(line.store, Use::write);
    return plan(options);
  }
  int operator()(const RunOptions& options) const {
    const HostLock lock(line.store, Use::run);
    return run(options);
  }
  int operator()(const StatusOptions& options) const {
    const HostLock lock(line.store, Use::read);
    return status(options);
  }
  int operator()(const ExplainCommand& command) const {
    const HostLock lock(line.store, Use::read);
    return explain_job(line.store, command.job_id, line.json);
  }
  int operator()(const QueryCommand& command) const {
    const HostLock lock(line.store, Use::read);
    return query(line.store, command.sql, command.format);
  }
  int operator()(const FigureRequest& request) const {
    const HostLock lock(line.store, Use::read);
    PrintableStream report;
    return draw_figures(schema::Reader(line.store), request, report);
  }
  int operator()(const PlotOptions& options) const { return plot(line.store, options); }
  int operator()(const ExportOptions& options) const {
    const HostLock lock(line.store, Use::read);
    return export_state(line.store, options, std::cout);
  }
  int operator()(const CostRequest& request) const {
    const HostLock lock(line.store, Use::read);
    PrintableStream report;
    return cost(schema::Reader(line.store), request, report);
  }
  int operator()(const VerifyOptions& options) const {
    const HostLock lock(line.store, options.repair ? Use::write : Use::read);
    return verify(options);
  }
  int operator()(const RetryCommand&) const {
    const HostLock lock(line.store, Use::write);
    return retry(line.store, line.json);
  }
  int operator()(const CancelOptions& options) const {
    const HostLock lock(line.store, options.dry_run ? Use::read : Use::write);
    return cancel(options);
  }
  int operator()(const SplitOptions& options) const {
    const HostLock lock(line.store, Use::write);
    return split(options);
  }
  int operator()(const MergeOptions& options) const {
    const HostLock lock(line.store, Use::write);
    return merge(options);
  }
  int operator()(const RecallOptions& options) const {
    const HostLock lock(line.store, Use::write);
    return recall(options);
  }
  int operator()(const SubmitOptions& options) const {
    const HostLock lock(
        line.store, Use::write,
        options.round == 0 ? HostLock::usual_patience : HostLock::unattended_patience);
    return submit(options);
  }
  int operator()(const TaskOptions& options) const { return task(options); }
  int operator()(const TheoryOptions& options) const { return theory(options); }
  int operator()(const BackupCommand& command) const {
    const HostLock lock(line.store, Use::read);
    return back_up(line.store, command.to);
  }
  int operator()(const UpgradeCommand&) const {
    const HostLock lock(line.store, Use::write);
    return upgrade(line.store);
  }
  int operator()(const ReportOptions& options) const {
    const HostLock lock(line.store, Use::read);
    return report(options);
  }
  int operator()(const WorkerCommand& command) const {
    std::optional<Deadline> deadline;
    if (command.until) deadline = Deadline(Deadline::duration(*command.until));
    return work(line.store, command.report_descriptor,
                {.deadline = deadline,
                 .share = command.share,
                 .where = command.where,
                 .order = command.order});
  }
};

// The exit code that tells what went wrong.
int exit_code_of(const std::exception& error) {
  if (stop_signal() != 0) return exit_signal_base + stop_signal();
  const bool is_bad_input = dynamic_cast<const schema::GridError*>(&error) != nullptr ||
                            dynamic_cast<const schema::NameError*>(&error) != nullptr ||
                            dynamic_cast<const schema::QueryError*>(&error) != nullptr ||
                            dynamic_cast<const TheoryError*>(&error) != nullptr ||
                            dynamic_cast<const QuestionError*>(&error) != nullptr ||
                            dynamic_cast<const UnknownFigure*>(&error) != nullptr;
  return is_bad_input ? exit_bad_input : exit_failed;
}

int perform(const CommandLine& line) try {
  set_up_log(line.verbose);
  return std::visit(CommandDispatcher{line}, line.command);
} catch (const std::exception& error) {
  const bool no_memory = dynamic_cast<const std::bad_alloc*>(&error) != nullptr;
  const std::string message = no_memory
                                  ? "no memory is left; close other programs or run fewer workers"
                                  : error_text(error);
  const int exit_code = exit_code_of(error);
  if (line.json)
    complain_lines(error_json(message, exit_code));
  else
    complain("campaign: {}\n", message);
  return exit_code;
}

int perform(int argc, char** argv) {
  const Parsed parsed = parse_command_line(argc, argv);
  const int* exit_code = std::get_if<int>(&parsed);
  return exit_code != nullptr ? *exit_code : perform(std::get<CommandLine>(parsed));
}

}  // namespace

int main(int argc, char** argv) {
  hold_standard_descriptors();
  return checked_output(perform(argc, argv));
}
