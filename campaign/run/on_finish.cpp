// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/run/on_finish.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <vector>

#include "campaign/base/output/output.hpp"
#include "campaign/base/process/signals.hpp"

namespace haff::campaign {
namespace {

std::vector<std::string> environment_with(const RunOutcome& outcome) {
  std::vector<std::string> all{
      "CAMPAIGN_EXIT_CODE=" + std::to_string(outcome.exit_code),
      "CAMPAIGN_DONE=" + std::to_string(outcome.done),
      "CAMPAIGN_FAILED=" + std::to_string(outcome.failed),
      "CAMPAIGN_PENDING=" + std::to_string(outcome.pending),
      "CAMPAIGN_STORE=" + std::filesystem::absolute(outcome.store).string(),
  };
  const std::size_t ours = all.size();
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    const std::string name = text.substr(0, text.find('=') + 1);
    bool is_ours = false;
    for (std::size_t k = 0; k < ours; ++k) is_ours |= all[k].starts_with(name);
    if (!is_ours) all.push_back(text);
  }
  return all;
}

// The child reacts to signals in the default way, not in the way of this process.
pid_t start(const std::string& command, const RunOutcome& outcome) {
  std::vector<std::string> environment = environment_with(outcome);
  std::vector<char*> entries;
  entries.reserve(environment.size() + 1);
  for (std::string& entry : environment) entries.push_back(entry.data());
  entries.push_back(nullptr);
  std::string shell = "/bin/sh", option = "-c", text = command;
  char* words[] = {shell.data(), option.data(), text.data(), nullptr};

  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t usual, none;
  sigemptyset(&usual);
  sigemptyset(&none);
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1, SIGUSR2, SIGXCPU, SIGXFSZ, SIGPIPE})
    sigaddset(&usual, signal);
  posix_spawnattr_setsigdefault(&attributes, &usual);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
  pid_t child = 0;
  const int error = posix_spawn(&child, shell.c_str(), nullptr, &attributes, words, entries.data());
  posix_spawnattr_destroy(&attributes);
  if (error == 0) return child;
  complain("campaign: --on-finish: the command cannot be started: {}\n", std::strerror(error));
  return 0;
}

}  // namespace

void run_on_finish(const std::string& command, const RunOutcome& outcome) {
  std::fflush(stdout);
  const pid_t child = start(command, outcome);
  if (child == 0) return;
  int passed_on = stop_signals();
  int state = 0;
  while (waitpid(child, &state, 0) < 0) {
    if (errno != EINTR) return;
    if (stop_signals() > passed_on) kill(child, stop_signal());
    passed_on = stop_signals();
  }
  if (WIFEXITED(state) && WEXITSTATUS(state) == 0) return;
  complain("campaign: --on-finish: the command {} {}: {}\n",
           WIFSIGNALED(state) ? "was ended by signal" : "ended with exit code",
           WIFSIGNALED(state) ? WTERMSIG(state) : WEXITSTATUS(state), command);
}

}  // namespace haff::campaign
