// SPDX-License-Identifier: GPL-3.0-or-later

// The program's output on a terminal, and what happens when its output cannot be written.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <filesystem>

#include "cli/program.hpp"

using namespace haff::tests;
using namespace std::chrono_literals;

namespace {

constexpr const char* small_grid =
    R"({"e": 0.8, "n": 0.4, "N": 500, "seeds": 2, "tau_max": 20, "observables": ["temperature"]})";

void plan(const Folder& folder, const std::string& grid) {
  folder.write("grid.json", grid);
  REQUIRE(campaign(folder, {"plan", "grid.json"}).exit_code == 0);
}

// A program whose stdout and stderr are a terminal of 80 columns and this many lines.
class OnTerminal {
 public:
  OnTerminal(const Folder& folder, std::vector<std::string> words, unsigned short lines) {
    winsize size{.ws_row = lines, .ws_col = 80, .ws_xpixel = 0, .ws_ypixel = 0};
    id_ = forkpty(&screen_, nullptr, nullptr, &size);
    if (id_ != 0) return;
    if (chdir((folder / "").c_str()) != 0) _exit(126);
    words.insert(words.begin(), campaign_path);
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    execv(arguments.front(), arguments.data());
    _exit(127);
  }
  ~OnTerminal() {
    if (id_ > 0) {
      kill(id_, SIGKILL);
      waitpid(id_, nullptr, 0);
    }
    hang_up();
  }
  OnTerminal(const OnTerminal&) = delete;
  OnTerminal& operator=(const OnTerminal&) = delete;

  // Closes the terminal.
  void hang_up() {
    if (screen_ >= 0) close(screen_);
    screen_ = -1;
  }

  // All output until the program closed the terminal, or for this long.
  std::string read_for(std::chrono::milliseconds time) {
    const auto until = std::chrono::steady_clock::now() + time;
    std::string text;
    while (std::chrono::steady_clock::now() < until) {
      pollfd ready{screen_, POLLIN, 0};
      if (poll(&ready, 1, 20) <= 0) continue;
      std::array<char, 4096> buffer{};
      const ssize_t size = read(screen_, buffer.data(), buffer.size());
      if (size <= 0) break;
      text.append(buffer.data(), static_cast<std::size_t>(size));
    }
    return text;
  }

  int exit_code() {
    int status = 0;
    waitpid(id_, &status, 0);
    id_ = 0;
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  }

 private:
  int screen_ = -1;
  pid_t id_ = 0;
};

// A terminal sequence that the program does not use itself for its bars and colours.
constexpr const char* sequence = "char(27) || ']0;pwned' || char(7)";

bool reaches_terminal(const std::string& text) {
  return text.find("\033]0;pwned") != std::string::npos;
}

}  // namespace

TEST_CASE("terminal: a command whose output cannot be written says so and ends with 1") {
  const Folder folder;
  plan(folder, small_grid);
  REQUIRE(campaign(folder, {"run"}).exit_code == 0);
  for (const std::string command :
       {"status", "status --json", "verify", "plan grid.json", "plan grid.json --dry-run", "run",
        "retry", "query 'SELECT * FROM jobs'", "query 'SELECT * FROM jobs' --format csv",
        "query 'SELECT * FROM jobs' --format json", "export 1", "cost", "--help", "--version"})
    for (const std::string to : {">/dev/full", ">&-"}) {
      CAPTURE(command);
      CAPTURE(to);
      const Outcome outcome = shell(folder, "\"$campaign\" " + command + ' ' + to);
      CHECK(outcome.exit_code == 1);
      CHECK(outcome.err.find("written") != std::string::npos);
    }
}

TEST_CASE("terminal: a run with stdin, stdout and stderr closed does its work") {
  const Folder folder;
  plan(folder, small_grid);
  shell(folder, "\"$campaign\" run <&- >&- 2>&-");
  CHECK(number(folder, "SELECT count(*) FROM jobs WHERE status = 'done'") == 4);
  CHECK(campaign(folder, {"verify"}).exit_code == 0);
}

TEST_CASE("terminal: text of a store does not reach the terminal as a command") {
  const Folder folder;
  plan(folder, small_grid);
  REQUIRE(campaign(folder, {"run"}).exit_code == 0);
  const std::string columns[] = {"error", "host", "code_version", "created", "started", "finished"};
  for (const std::string& column : columns) {
    CAPTURE(column);
    edit_unnoticed(folder, "UPDATE jobs SET status = 'failed', " + column + " = " + sequence +
                               " WHERE job_id = 2");
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"status"},
          {"status", "--json"},
          {"verify"},
          {"retry"},
          {"plan", "grid.json", "--dry-run"},
          {"query", "SELECT * FROM jobs"},
          {"query", "SELECT * FROM jobs", "--format", "csv"},
          {"query", "SELECT * FROM jobs", "--format", "json"},
          {"run"}}) {
      CAPTURE(command.front());
      OnTerminal program(folder, command, 50);
      CHECK_FALSE(reaches_terminal(program.read_for(20s)));
    }
  }
}

TEST_CASE("terminal: host and error of a running job are shown without terminal commands") {
  const Folder folder;
  plan(folder, small_grid);
  edit_unnoticed(
      folder, std::string("UPDATE jobs SET status = 'running', owner_pid = 1, owner_boot_id = ") +
                  sequence + ", owner_started = 1, renewed = " + sequence + ", host = " + sequence +
                  ", error = " + sequence + " WHERE job_id = 1");
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"status"}, {"status", "--json"}, {"run", "--max-time", "1s"}}) {
    OnTerminal program(folder, command, 50);
    CHECK_FALSE(reaches_terminal(program.read_for(20s)));
  }
}

TEST_CASE("terminal: more workers than the terminal has lines are shown as one line") {
  const Folder folder;
  plan(folder, R"({"e": 0.8, "n": 0.4, "N": 4000, "seeds": 12, "tau_max": 60})");
  OnTerminal run(folder, {"run", "--workers", "8"}, 6);
  const std::string shown = run.read_for(1500ms);
  CHECK(shown.find("jobs done") != std::string::npos);
  CHECK(shown.find("waiting") == std::string::npos);
  CHECK(shown.find("collisions/s") == std::string::npos);
  CHECK(shown.find("\033[9A") == std::string::npos);  // up by no more lines than there are
}

TEST_CASE("terminal: closing it stops a run in order, and the next run goes on") {
  const Folder folder;
  plan(folder, R"({"e": 0.9, "n": 0.4, "N": 1000, "seeds": 2, "tau_max": 2000})");
  OnTerminal run(folder, {"run", "--workers", "2"}, 24);
  while (number(folder, "SELECT max(tau_reached) FROM jobs WHERE kind = 'cooling'") == 0)
    run.read_for(20ms);
  run.hang_up();
  CHECK(run.exit_code() == 128 + SIGHUP);
  CHECK(number(folder, "SELECT count(*) FROM jobs WHERE status = 'running'") == 0);
  CHECK(number(folder, "SELECT sum(attempts) FROM jobs") == 0);
  CHECK(number(folder, "SELECT count(*) FROM checkpoints") > 0);
}

TEST_CASE("terminal: suggested commands can be pasted, from any folder and for any store") {
  const Folder folder;
  const std::filesystem::path place = folder / "my runs/a b";
  std::filesystem::create_directories(place);
  folder.write("my runs/a b/the grid's.json", small_grid);
  // Pastes each line that is a command, whatever words introduce it.
  const Outcome outcome = shell(folder, R"(
    cd 'my runs/a b'
    campaign() { "$campaign" "$@"; }
    paste() {
      sed -n -E 's/^(.*[^a-z])?(campaign (plan|run|retry|status|verify|figures) .*)$/\2/p' "$1" > commands
      while IFS= read -r line; do
        echo "pasted: $line"
        eval "$line" > out 2>&1 || { echo "exit $? of: $line"; cat out; exit 1; }
      done < commands
    }
    store="it's a store.db"
    campaign plan "the grid's.json" --store "$store" --dry-run > shown && paste shown
    campaign plan "the grid's.json" --store "$store" > shown && paste shown
    campaign status --store "$store" > shown && paste shown
    sqlite3 "$store" "UPDATE jobs SET status = 'failed', error = 'x' WHERE job_id = 4;
                      UPDATE digests SET jobs = NULL"
    campaign status --store "$store" > shown && paste shown
    campaign retry --store "$store" > shown && paste shown
    campaign status --store "$store" > shown)");
  CAPTURE(outcome.out);
  CAPTURE(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out.find("pasted: campaign plan") != std::string::npos);
  CHECK(outcome.out.find("pasted: campaign run") != std::string::npos);
  CHECK(outcome.out.find("pasted: campaign retry") != std::string::npos);
}
