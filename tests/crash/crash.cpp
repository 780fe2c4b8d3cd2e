// A small campaign whose disk loses power or fails, over and over: what is there afterwards is
// sound, and the same commands end with the same rows.
//
//   crash power --seed 1 --images 100           images of the disk after power loss
//   crash power --seed 1 --only 37              one of them again; its folder is kept
//   crash fail --seed 1 --cases 100             a call that fails, once or from then on
//   crash fail --seed 1 --only 37
//
// An image or a case follows from its seed and its number alone; the record that images are made
// from is that of several processes, and differs from one run to the next in the order of what they
// wrote.
#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <sys/wait.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>

#include "crash/power_loss.hpp"
#include "support/temporary_folder.hpp"

namespace haff::tests {
namespace {

constexpr const char* program = HAFF_CAMPAIGN_FAULTY;
constexpr const char* store_name = "c.db";

// Every table has rows: profiles, fields, an effect with a memory of its own, results.
constexpr const char* grid = R"({
  "n": 0.2, "N": 108, "tau_max": 30, "equilibrate": 10, "grids": [
  {"e": 0.8, "seeds": 2, "profiles_every": 10, "fields_at": [20],
   "observables": ["temperature", "laguerre", "distribution", "correlations", "fields"]},
  {"e": 0.9, "seeds": 1, "effects": {"roughness": {"beta": 0.5, "q": 0.4}}}]})";

struct Result {
  int exit_code = 0;  // 128 + signal if one ended it; 124 after a minute
  std::string said;
};

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

Result shell(const std::filesystem::path& folder, const std::string& words,
             const std::string& environment = "") {
  const std::string command =
      fmt::format("cd '{}' && {} timeout -k 1 60 '{}' --store {} {} > said 2>&1", folder.string(),
                  environment, program, store_name, words);
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
          text_of(folder / "said")};
}

// All that the physics of a store is, reals with all their digits.
std::string rows(const std::filesystem::path& folder) {
  const SQLite::Database store((folder / store_name).string(), SQLite::OPEN_READONLY, 10'000);
  std::string all;
  for (const char* sql :
       {"SELECT identity, status, quote(samples.tau), quote(time), quote(temperature), "
        "quote(gamma_ratio), quote(collision_rate), quote(pressure), quote(a2), quote(a6), "
        "quote(rotational_temperature) FROM samples JOIN jobs USING (job_id) ORDER BY 1, "
        "samples.tau",
        "SELECT identity, name, quote(profiles.tau), quote(x), quote(value) FROM profiles JOIN "
        "jobs USING (job_id) ORDER BY identity, name, profiles.tau, x",
        "SELECT identity, name, quote(fields.tau), hex(data) FROM fields JOIN jobs USING (job_id) "
        "ORDER BY identity, name, fields.tau",
        "SELECT identity, quote(tau_c), quote(time_c) FROM results JOIN jobs USING (job_id) ORDER "
        "BY identity"}) {
    SQLite::Statement row(store, sql);
    while (row.executeStep()) {
      for (int k = 0; k < row.getColumnCount(); ++k) all += row.getColumn(k).getString() + ' ';
      all += '\n';
    }
  }
  return all;
}

bool contains(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

void must_succeed(const Result& result) {
  if (result.exit_code != 0) throw std::runtime_error("the campaign itself fails: " + result.said);
}

// Plans and runs again until all is done: what is wrong on the way, or nothing.
std::optional<std::string> complete(const std::filesystem::path& folder, bool may_lack_jobs,
                                    const std::string& expected) {
  if (may_lack_jobs)
    if (const Result plan = shell(folder, "plan grid.json"); plan.exit_code != 0)
      return "the next plan fails: " + plan.said;
  Result run = shell(folder, "run --workers 1");
  if (run.exit_code == 1 && contains(run.said, "retry")) {
    shell(folder, "retry");
    run = shell(folder, "run --workers 1");
  }
  if (run.exit_code != 0) return "the next run fails: " + run.said;
  if (rows(folder) != expected) return "the rows differ in the end";
  if (const Result end = shell(folder, "verify"); end.exit_code != 0)
    return "in the end: " + end.said;
  return std::nullopt;
}

// ---- power loss -------------------------------------------------------------------------------

class PowerLoss {
 public:
  PowerLoss() {
    std::ofstream(folder_ / "grid.json") << grid;
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
    std::ofstream(folder / "grid.json") << grid;
    const std::size_t count = moment(random);
    const auto fate = static_cast<Fate>(random() % fates);
    make_image(operations_, count, fate, random, folder, store_name);
    const bool while_planning = count <= planned_;
    const auto named = [&](std::string what) {
      return fmt::format("after {} of {} operations ({} of the plan), fate {}: {}", count,
                         operations_.size(), planned_, static_cast<int>(fate), what);
    };
    const Result verified = shell(folder, "verify");
    const bool is_unfinished = contains(verified.said, "is empty; make it with") ||
                               contains(verified.said, "there is no such store");
    // The log is deleted before the file says so.
    const bool lacks_log = contains(verified.said, "Its newest rows may be missing") &&
                           !contains(verified.said, "fault");
    if (verified.exit_code != 0 && !(while_planning && is_unfinished) && !lacks_log)
      return named("verify says: " + verified.said);
    if (const auto wrong = complete(folder, while_planning, expected_)) return named(*wrong);
    return std::nullopt;
  }

 private:
  // Around a sync, a truncation, a file made or deleted more often than elsewhere, and more often
  // in the short plan than its share.
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
  int calls;  // of a command, about: which one fails is chosen from so many
};

const std::vector<Failure> failures{
    {"read", {EIO, EINTR}, 60},         {"write", {ENOSPC, EIO, EDQUOT}, 60},
    {"sync", {EIO, EINTR}, 8},          {"truncate", {EIO, ENOSPC}, 4},
    {"open", {EMFILE, EACCES, EIO}, 8}, {"delete", {EACCES, EIO}, 3},
    {"allocate", {ENOMEM}, 3000}};

class FailingCalls {
 public:
  FailingCalls() {
    std::ofstream(folder_ / "grid.json") << grid;
    must_succeed(shell(folder_.path(), "plan grid.json"));
    std::filesystem::copy_file(folder_ / store_name, folder_ / "planned.db");
    must_succeed(shell(folder_.path(), "run --workers 1"));
    expected_ = rows(folder_.path());
  }

  std::optional<std::string> fault(std::mt19937_64& random,
                                   const std::filesystem::path& folder) const {
    constexpr std::array commands{"plan grid.json",
                                  "run --workers 1",
                                  "verify",
                                  "status",
                                  "retry",
                                  "backup copy.db",
                                  "query 'SELECT * FROM mean_tau_c'"};
    const std::string command = commands[random() % commands.size()];
    const bool plans = command.starts_with("plan");
    const bool runs = command.starts_with("run");
    const Failure& failure = failures[random() % failures.size()];
    const int error = failure.errors[random() % failure.errors.size()];
    // The first ones more often: opening a store is full of corners.
    const auto number =
        1 + random() % (random() % 2 == 0 ? static_cast<unsigned>(failure.calls)
                                          : static_cast<unsigned>(failure.calls) / 4 + 1);
    // EINTR for ever is no failure, but a machine that does nothing else.
    const bool for_ever = random() % 2 == 0 && error != EINTR;
    const char* where = runs && random() % 2 == 0 ? "worker" : "main";

    std::ofstream(folder / "grid.json") << grid;
    if (!plans)
      std::filesystem::copy_file(folder_ / (runs ? "planned.db" : store_name), folder / store_name);
    const Result result = shell(
        folder, command,
        fmt::format("HAFF_FAIL={}:{}:{}:{} HAFF_FAIL_IN={} HAFF_FAILED='{}'", failure.kind, number,
                    error, for_ever ? "ever" : "once", where, (folder / "failed").string()));
    if (!std::filesystem::exists(folder / "failed")) return std::nullopt;  // there was no such call
    ++failed_;
    const auto named = [&](const std::string& what) {
      return fmt::format("{}: {} {} of {} fails {} with errno {}, exit {}: {}\nIt said: {}",
                         command, failure.kind, number, where, for_ever ? "for ever" : "once",
                         error, result.exit_code, what, result.said);
    };
    if (result.exit_code != 0 && result.exit_code != 1)
      return named("0 or 1 is expected: 2 is for what the user types");
    if (result.exit_code == 1 && result.said.empty()) return named("says nothing");
    if (contains(result.said, "damaged (") || contains(result.said, "malformed"))
      return named("a sound store is called damaged");
    if (const auto wrong = complete(folder, plans, expected_)) return named(*wrong);
    return std::nullopt;
  }

  int failed() const { return failed_; }

 private:
  TemporaryFolder folder_;
  std::string expected_;
  mutable int failed_ = 0;
};

// ---- the program ------------------------------------------------------------------------------

struct Options {
  unsigned long seed = 1;
  int count = 40;
  std::optional<int> only;
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
  auto* fail = app.add_subcommand("fail", "A read, write, sync, ... that fails");
  for (auto* command : {power, fail}) {
    command->add_option("--seed", options.seed, "Chooses what happens")->capture_default_str();
    command->add_option(command == power ? "--images" : "--cases", options.count, "How many")
        ->capture_default_str();
    command->add_option("--only", options.only, "The one of this number");
  }
  CLI11_PARSE(app, argc, argv);
  if (power->parsed()) return try_all(PowerLoss(), options, "power");
  const FailingCalls calls;
  const int result = try_all(calls, options, "fail");
  fmt::print("{} calls failed\n", calls.failed());
  return result;
}
