// `campaign run`: the coordinator. It starts workers, listens to them, replaces those that die and
// takes back the jobs of the dead; the workers choose and do the jobs by themselves.
#pragma once

#include <filesystem>
#include <optional>

namespace haff::campaign {

struct RunOptions {
  std::filesystem::path store;
  int workers = 1;
  std::optional<double> max_seconds;  // wall clock
  std::optional<double> cpu_budget;   // of all workers together [s]
};

// Runs all that is pending, then adds realizations until the store's targets are met; returns an
// ExitCode.
int run(const RunOptions& options);

}  // namespace haff::campaign
