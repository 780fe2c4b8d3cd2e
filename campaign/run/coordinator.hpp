// SPDX-License-Identifier: GPL-3.0-or-later

// The coordinator of a run: it starts workers, listens to them, replaces those that die and takes
// back their jobs. The workers choose and do the jobs by themselves.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "campaign/run/event_log.hpp"
#include "schema/store/planning/choice.hpp"

namespace haff::campaign {

struct RunOptions {
  std::filesystem::path store;
  int workers = 1;
  // For each worker. 0: the processors, one for each worker, are shared out among the jobs.
  int threads = 0;
  std::optional<double> max_seconds;  // wall clock
  std::optional<double> cpu_budget;   // of all workers together [s]
  std::filesystem::path log_json;     // events go here as lines of JSON; empty: nowhere
  std::string on_finish;              // a command for the shell, given at the end; empty: none
  bool json = false;                  // print what came of it as JSON
  std::string where, order;  // which jobs, in which order (schema/store/planning/choice.hpp)
};

// What ended a round before its work was done.
struct RoundEnd {
  bool over_limit = false;   // --max-time or --budget
  bool store_error = false;  // a worker could not use the store
  // Jobs were left because nothing of them could be stored within --max-time: what the shortest of
  // them needs. [s]
  std::optional<double> seconds_needed;
};

// Runs all pending jobs that are chosen, and returns when all workers have ended. `start` is when
// the whole run began, of which this may be a later round: its time limit counts from there.
RoundEnd run_round(schema::Selection& store, const RunOptions& options,
                   std::chrono::steady_clock::time_point start, EventLog& log);

}  // namespace haff::campaign
