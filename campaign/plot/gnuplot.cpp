// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/plot/gnuplot.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <system_error>

#include "campaign/base/text/printable.hpp"

namespace haff::campaign {
namespace {

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

// A file without a name, gone when closed. gnuplot reads its script from one, draws into another
// and complains into a third, so that neither side can block the other as with pipes.
File nameless() {
  File file(std::tmpfile());
  if (!file) throw std::system_error(errno, std::generic_category(), "no temporary file");
  return file;
}

std::string contents(std::FILE* file) {
  std::rewind(file);
  std::string text;
  char part[4096];
  while (const std::size_t got = std::fread(part, 1, sizeof part, file)) text.append(part, got);
  return text;
}

// gnuplot first shows the place in the script, and says in the last line what is wrong there.
std::string last_line(std::string text) {
  text.erase(text.find_last_not_of("\n ") + 1);
  return printable(text.substr(text.rfind('\n') + 1));
}

}  // namespace

std::string run_gnuplot(const std::string& script) {
  const File input = nameless(), output = nameless(), complaints = nameless();
  if (std::fwrite(script.data(), 1, script.size(), input.get()) != script.size() ||
      std::fflush(input.get()) != 0) {
    throw std::system_error(errno, std::generic_category(), "temporary file for gnuplot");
  }
  std::rewind(input.get());

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, fileno(input.get()), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, fileno(output.get()), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, fileno(complaints.get()), STDERR_FILENO);
  char name[] = "gnuplot";
  char defaults[] = "-d";  // without start-up files
  // By this name gnuplot reads its input in large pieces; without it, byte by byte.
  char script_file[] = "/dev/stdin";
  char* arguments[] = {name, defaults, script_file, nullptr};
  pid_t child = 0;
  const int failure = posix_spawnp(&child, name, &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure == ENOENT) {
    throw GnuplotMissing(
        "gnuplot is not installed, pictures cannot be drawn: apt-get install gnuplot-nox");
  }
  if (failure != 0) throw std::system_error(failure, std::generic_category(), "gnuplot");

  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw std::runtime_error("gnuplot failed: " + last_line(contents(complaints.get())));
  }
  return contents(output.get());
}

}  // namespace haff::campaign
