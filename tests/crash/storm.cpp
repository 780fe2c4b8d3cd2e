// SPDX-License-Identifier: GPL-3.0-or-later

#include "crash/storm.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <fstream>
#include <thread>
#include <vector>

#include "crash/little_campaign.hpp"

namespace haff::tests {
namespace {

using namespace std::chrono_literals;

constexpr int rounds = 8;
constexpr int at_once = 4;
constexpr auto patience = 60s;  // a command that takes longer hangs

// A command that runs on its own, as the leader of a process group.
class Process {
 public:
  Process(const std::filesystem::path& folder, std::string words, int number, int clock)
      : words_(std::move(words)), said_(folder / fmt::format("said-{}", number)) {
    const std::string line = fmt::format("cd '{}' && HAFF_CLOCK={} exec '{}' {} > '{}' 2>&1",
                                         folder.string(), clock, program, words_, said_.string());
    id_ = fork();
    if (id_ != 0) return;
    setpgid(0, 0);
    execl("/bin/sh", "sh", "-c", line.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }

  bool is_run() const { return words_.starts_with("run"); }

  // Kills the command alone, so that its workers lose it, or the whole group.
  void strike(bool all) {
    is_struck_ = true;
    kill(all ? -id_ : id_, SIGKILL);
  }
  void stop() const { kill(id_, SIGTERM); }

  // Waits for the end. Returns what is wrong with it, or nothing.
  std::optional<std::string> end() {
    int status = 0;
    const auto until = std::chrono::steady_clock::now() + patience;
    while (waitpid(id_, &status, WNOHANG) == 0) {
      if (std::chrono::steady_clock::now() > until) {
        kill(-id_, SIGKILL);
        waitpid(id_, &status, 0);
        return words_ + " hangs";
      }
      std::this_thread::sleep_for(2ms);
    }
    if (is_struck_) return std::nullopt;
    const int exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    const std::string said = text_of(said_);
    const bool is_expected = exit_code == 0 || (is_run() && exit_code == 128 + SIGTERM);
    if (is_expected && !contains(said, "damaged (") && !contains(said, "malformed"))
      return std::nullopt;
    return fmt::format("{}: exit {}: {}", words_, exit_code, said);
  }

 private:
  std::string words_;
  std::filesystem::path said_;
  pid_t id_ = 0;
  bool is_struck_ = false;
};

constexpr std::array commands{
    "run --store c.db --workers 2",
    "run --store c.db --workers 1",
    "run --store shards/shard-001.db --workers 1",
    "run --store shards/shard-002.db --workers 1",
    "plan all.json --store c.db",
    "merge shards/shard-001.db --store c.db",
    "merge shards/shard-002.db shards/shard-001.db --store c.db",
    "retry --store c.db",
    "verify --store c.db",
    "status --store c.db",
    "query 'SELECT e, tau, temperature, temperature_se FROM mean_series' --store c.db",
};

// Each command has a clock of its own. [s ahead]
constexpr std::array clocks{0, 600, -600, 100'000'000, -100'000'000};

std::optional<std::string> one_round(std::mt19937_64& random, const std::filesystem::path& folder,
                                     int& kills) {
  std::vector<Process> processes;
  processes.reserve(at_once);
  for (int k = 0; k < at_once; ++k)
    processes.emplace_back(folder, commands[random() % commands.size()], k,
                           clocks[random() % clocks.size()]);
  for (Process& process : processes) {
    std::this_thread::sleep_for(std::chrono::milliseconds(random() % 60));
    if (random() % 3 != 0) {
      process.strike(random() % 2 == 0);
      ++kills;
    } else if (process.is_run()) {
      process.stop();
    }
  }
  std::optional<std::string> wrong;
  for (Process& process : processes)
    if (auto fault = process.end(); fault && !wrong) wrong = fault;
  return wrong;
}

}  // namespace

Storm::Storm(double tau_max) : tau_max_(tau_max) {
  const TemporaryFolder folder;
  std::ofstream(folder / "all.json") << grid(tau_max_, 2);
  must_succeed(shell(folder.path(), "plan all.json"));
  must_succeed(shell(folder.path(), "run --workers 2"));
  expected_ = rows(folder.path());
}

std::optional<std::string> Storm::fault(std::mt19937_64& random,
                                        const std::filesystem::path& folder) const {
  std::ofstream(folder / "some.json") << grid(tau_max_, 1);
  std::ofstream(folder / "all.json") << grid(tau_max_, 2);
  must_succeed(shell(folder, "plan some.json"));
  must_succeed(shell(folder, "split --into 2"));
  for (int k = 0; k < rounds; ++k)
    if (auto wrong = one_round(random, folder, kills_))
      return fmt::format("in round {}: {}", k, *wrong);

  for (const char* words :
       {"run --store shards/shard-001.db", "run --store shards/shard-002.db",
        "merge shards/shard-001.db shards/shard-002.db --store c.db", "plan all.json --store c.db"})
    if (const Result result = run_program(folder, words); result.exit_code != 0)
      return fmt::format("after the storm: {}: exit {}: {}", words, result.exit_code, result.said);
  return complete(folder, false, expected_);
}

}  // namespace haff::tests
