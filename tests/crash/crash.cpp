// SPDX-License-Identifier: GPL-3.0-or-later

// A small campaign whose disk loses power or fails, again and again. Afterwards the store must be
// sound, and the same commands must end with the same rows.
//
//   crash power --seed 1 --images 100           images of the disk after power loss
//   crash power --seed 1 --only 37              one of them again; its folder is kept
//   crash fail --seed 1 --cases 100             a call that fails, once or from then on
//   crash fail --seed 1 --only 37
//   crash fail --every sync                     each call of a kind in turn, once and from then on
//   crash storm --seed 1 --storms 10            many commands at once, killed at any moment
//   crash clock                                 two runs at once whose clocks differ
//
// An image or a case follows from its seed and its number alone. Images, however, are made from a
// record of several processes, whose writes may come in another order in each run.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <future>
#include <optional>
#include <string>

#include "crash/little_campaign.hpp"
#include "crash/power_loss.hpp"
#include "crash/storm.hpp"
#include "support/temporary_folder.hpp"

namespace haff::tests {
namespace {

// [collisions per particle]
constexpr double tau_max = 30;
constexpr double tau_max_of_a_storm = 300;  // long enough to be killed in many places

// ---- power loss -------------------------------------------------------------------------------

class PowerLoss {
 public:
  PowerLoss() {
    std::ofstream(folder_ / "grid.json") << grid(tau_max, 1);
    const std::string traced = "HAFF_TRACE='" + (folder_ / "trace").string() + "'";
    must_succeed(shell(folder_.path(), "plan grid.json", traced));
    planned_ = read_trace(folder_ / "trace").size();
    must_succeed(shell(folder_.path(), "run --workers 2", traced));
    operations_ = read_trace(folder_ / "trace");
    for (std::size_t k = 0; k < operations_.size(); ++k)
      if (operations_[k].header.event != Event::write) turns_.push_back(k);
    expected_ = rows(folder_.path());
  }

  std::optional<std::string> fault(std::mt19937_64& random,
                                   const std::filesystem::path& folder) const {
    std::ofstream(folder / "grid.json") << grid(tau_max, 1);
    const std::size_t count = moment(random);
    const auto fate = static_cast<Fate>(random() % fates);
    make_image(operations_, count, fate, random, folder, store_name);
    const bool while_planning = count <= planned_;
    const auto named = [&](std::string what) {
      return fmt::format("after {} of {} operations ({} of the plan), fate {}: {}", count,
                         operations_.size(), planned_, static_cast<int>(fate), what);
    };
    const Result verified = shell(folder, "verify");
    const bool is_unfinished = contains(verified.said, "is empty (a plan that was cut off") ||
                               contains(verified.said, "there is no such store");
    if (verified.exit_code != 0 && !(while_planning && is_unfinished))
      return named("verify says: " + verified.said);
    if (const auto wrong = complete(folder, while_planning, expected_)) return named(*wrong);
    return std::nullopt;
  }

 private:
  // Moments around a sync, a truncation, or the creation or deletion of a file are more frequent
  // than others, and so are moments in the short plan.
  std::size_t moment(std::mt19937_64& random) const {
    const auto way = random() % 4;
    if (way == 0) return 1 + random() % planned_;
    if (way == 1) return 1 + random() % operations_.size();
    const std::size_t turn = turns_[random() % turns_.size()];
    return std::clamp<std::size_t>(turn + random() % 8, 1, operations_.size());
  }

  TemporaryFolder folder_;
  std::vector<Operation> operations_;
  std::size_t planned_ = 0;
  std::vector<std::size_t> turns_;
  std::string expected_;
};

// ---- calls that fail --------------------------------------------------------------------------

struct Failure {
  const char* kind;
  std::vector<int> errors;
  int calls;  // about so many per command; the failing one is chosen among them
};

const std::vector<Failure> failures{
    {"read", {EIO, EINTR}, 60},         {"write", {ENOSPC, EIO, EDQUOT}, 60},
    {"sync", {EIO, EINTR}, 8},          {"truncate", {EIO, ENOSPC}, 4},
    {"open", {EMFILE, EACCES, EIO}, 8}, {"delete", {EACCES, EIO}, 3},
    {"allocate", {ENOMEM}, 3000}};

class FailingCalls {
 public:
  FailingCalls() {
    std::ofstream(folder_ / "grid.json") << grid(tau_max, 1);
    must_succeed(shell(folder_.path(), "plan grid.json"));
    std::filesystem::copy_file(folder_ / store_name, folder_ / "planned.db");
    must_succeed(shell(folder_.path(), "run --workers 1"));
    expected_ = rows(folder_.path());
  }

  std::optional<std::string> fault(std::mt19937_64& random,
                                   const std::filesystem::path& folder) const {
    const std::string command = commands[random() % commands.size()];
    const Failure& failure = failures[random() % failures.size()];
    const int error = failure.errors[random() % failure.errors.size()];
    // The first calls fail more often, since opening a store has many special cases.
    const auto number =
        1 + random() % (random() % 2 == 0 ? static_cast<unsigned>(failure.calls)
                                          : static_cast<unsigned>(failure.calls) / 4 + 1);
    const bool for_ever = random() % 2 == 0;
    const bool in_worker = random() % 2 == 0;
    return fault({command, failure.kind, number, error, for_ever, in_worker}, folder);
  }

  // Lets each call of a kind fail in turn, in each command. Returns how many commands ended
  // wrongly.
  int every(const std::string& kind, unsigned stride) const {
    int faults = 0;
    for (const Failure& failure : failures)
      for (const char* command : commands)
        for (const int error : failure.errors)
          for (const bool for_ever : {false, true})
            for (const bool in_worker : {false, true})
              if (failure.kind == kind && (!in_worker || is_run(command)))
                faults += all_of({command, kind, 1, error, for_ever, in_worker}, stride);
    return faults;
  }

  int failed() const { return failed_; }

 private:
  struct Case {
    std::string command, kind;
    unsigned long number;
    int error;
    bool for_ever, in_worker;
  };

  static constexpr std::array commands{"plan grid.json",
                                       "run --workers 1",
                                       "verify",
                                       "status",
                                       "retry",
                                       "backup copy.db",
                                       "query 'SELECT * FROM mean_tau_c'"};

  static bool is_run(const std::string& command) { return command.starts_with("run"); }

  int all_of(Case one, unsigned stride) const {
    int faults = 0;
    for (;; one.number += stride) {
      const TemporaryFolder folder;
      const int before = failed_;
      if (const auto wrong = fault(one, folder.path())) {
        ++faults;
        fmt::print("{}\n", *wrong);
      }
      if (failed_ == before) return faults;  // the command does not make so many calls
    }
  }

  std::optional<std::string> fault(const Case& one, const std::filesystem::path& folder) const {
    const bool plans = one.command.starts_with("plan");
    const bool runs = is_run(one.command);
    // EINTR for ever would not be a failure but a machine that does nothing else.
    const bool for_ever = one.for_ever && one.error != EINTR;
    const char* where = runs && one.in_worker ? "worker" : "main";

    std::ofstream(folder / "grid.json") << grid(tau_max, 1);
    if (!plans)
      std::filesystem::copy_file(folder_ / (runs ? "planned.db" : store_name), folder / store_name);
    const Result result = shell(
        folder, one.command,
        fmt::format("HAFF_FAIL={}:{}:{}:{} HAFF_FAIL_IN={} HAFF_FAILED='{}'", one.kind, one.number,
                    one.error, for_ever ? "ever" : "once", where, (folder / "failed").string()));
    if (!std::filesystem::exists(folder / "failed")) return std::nullopt;  // no such call was made
    ++failed_;
    const auto named = [&](const std::string& what) {
      return fmt::format("{}: {} {} of {} fails {} with errno {}, exit {}: {}\nIt said: {}",
                         one.command, one.kind, one.number, where, for_ever ? "for ever" : "once",
                         one.error, result.exit_code, what, result.said);
    };
    if (result.exit_code != 0 && result.exit_code != 1)
      return named("0 or 1 is expected: 2 is for errors of the user");
    if (result.exit_code == 1 && result.said.empty()) return named("says nothing");
    if (contains(result.said, "damaged (") || contains(result.said, "malformed"))
      return named("a sound store is called damaged");
    if (const auto wrong = complete(folder, plans, expected_)) return named(*wrong);
    return std::nullopt;
  }

  TemporaryFolder folder_;
  std::string expected_;
  mutable int failed_ = 0;
};

// ---- clocks that differ -----------------------------------------------------------------------

// A run in another process namespace, as in a container, knows the workers of the first run only by
// their leases, whose times come from another clock.
class Clocks {
 public:
  Clocks() {
    std::ofstream(folder_ / "grid.json") << grid(tau_max_of_a_storm, 1);
    must_succeed(shell(folder_.path(), "plan grid.json"));
    std::filesystem::copy_file(folder_ / store_name, folder_ / "planned.db");
    must_succeed(shell(folder_.path(), "run --workers 2"));
    expected_ = rows(folder_.path());
  }

  static bool can_be_tried() {
    return std::system((std::string(elsewhere) + " true > /dev/null 2>&1").c_str()) == 0;
  }

  std::optional<std::string> fault(int ahead) const {
    const TemporaryFolder folder;
    std::filesystem::copy_file(folder_ / "planned.db", folder / store_name);
    const auto run = [&](const std::string& environment) {
      return shell(folder.path(), "run --workers 1", environment);
    };
    auto first = std::async(std::launch::async, run, "");
    const Result second = run(fmt::format("HAFF_CLOCK={} {}", ahead, elsewhere));
    for (const Result& result : {first.get(), second}) {
      const bool has_lost_a_job =
          contains(result.said, "taken back") || contains(result.said, "another worker");
      if (result.exit_code != 0 || has_lost_a_job)
        return fmt::format("with a clock {} s ahead: exit {}: {}", ahead, result.exit_code,
                           result.said);
    }
    if (rows(folder.path()) != expected_) return "the rows differ in the end";
    return std::nullopt;
  }

 private:
  static constexpr const char* elsewhere =
      "unshare --user --map-root-user --pid --fork --mount-proc";
  TemporaryFolder folder_;
  std::string expected_;
};

int try_clocks() {
  if (!Clocks::can_be_tried()) {
    fmt::print("Skipped: this machine does not let a user have a process namespace\n");
    return 0;
  }
  const Clocks clocks;
  int faults = 0;
  for (const int ahead : {600, -600, 1'000'000'000, -1'000'000'000})
    if (const auto fault = clocks.fault(ahead)) {
      ++faults;
      fmt::print("{}\n", *fault);
    }
  fmt::print("clock: {} wrong\n", faults);
  return faults == 0 ? 0 : 1;
}

// ---- the program ------------------------------------------------------------------------------

struct Options {
  unsigned long seed = 1;
  int count = 40;
  std::optional<int> only;
  std::string every;  // the kind of calls
  unsigned stride = 1;
};

template <class Trial>
int try_all(const Trial& trial, const Options& options, const char* name) {
  int faults = 0;
  for (int k = options.only.value_or(0); k < (options.only ? *options.only + 1 : options.count);
       ++k) {
    std::seed_seq words{static_cast<unsigned>(options.seed), static_cast<unsigned>(k)};
    std::mt19937_64 random(words);
    const TemporaryFolder folder;
    const auto fault = trial.fault(random, folder.path());
    if (!fault) continue;
    ++faults;
    fmt::print("crash {} --seed {} --only {}\n  {}\n", name, options.seed, k, *fault);
    if (options.only) {
      const auto kept = std::filesystem::current_path() / fmt::format("crash-{}-{}", name, k);
      std::filesystem::copy(folder.path(), kept, std::filesystem::copy_options::recursive);
      fmt::print("  kept in {}\n", kept.string());
    }
  }
  fmt::print("{} {}: {} tried, {} wrong\n", name, options.seed, options.only ? 1 : options.count,
             faults);
  return faults == 0 ? 0 : 1;
}

}  // namespace
}  // namespace haff::tests

int main(int argc, char** argv) {
  using namespace haff::tests;
  CLI::App app("A small campaign whose disk loses power or fails.");
  app.require_subcommand(1);
  Options options;
  auto* power = app.add_subcommand("power", "Images of the disk after power loss");
  auto* fail = app.add_subcommand("fail", "Calls of read, write, sync, ... that fail");
  auto* storm = app.add_subcommand("storm", "Many commands at once, killed at any moment");
  auto* clock = app.add_subcommand("clock", "Two runs at once whose clocks differ");
  fail->add_option("--every", options.every, "Let each call of this kind fail in turn")
      ->check(CLI::IsMember({"read", "write", "sync", "truncate", "open", "delete", "allocate"}));
  fail->add_option("--stride", options.stride, "Only every K-th of these calls")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  for (auto* command : {power, fail, storm}) {
    command->add_option("--seed", options.seed, "Seed of the random choices")
        ->capture_default_str();
    command
        ->add_option(command == power  ? "--images"
                     : command == fail ? "--cases"
                                       : "--storms",
                     options.count, "How many")
        ->capture_default_str();
    command->add_option("--only", options.only, "Only the one with this number");
  }
  CLI11_PARSE(app, argc, argv);
  if (clock->parsed()) return try_clocks();
  if (power->parsed()) return try_all(PowerLoss(), options, "power");
  if (storm->parsed()) {
    const Storm storms(tau_max_of_a_storm);
    const int result = try_all(storms, options, "storm");
    fmt::print("{} kills\n", storms.kills());
    return result;
  }
  const FailingCalls calls;
  const int result = !options.every.empty()
                         ? (calls.every(options.every, options.stride) == 0 ? 0 : 1)
                         : try_all(calls, options, "fail");
  fmt::print("{} calls failed\n", calls.failed());
  return result;
}
