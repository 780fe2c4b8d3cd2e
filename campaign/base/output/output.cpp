// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/base/output/output.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>

#include "campaign/base/process/exit_code.hpp"
#include "campaign/base/text/printable.hpp"

namespace haff::campaign {
namespace {

// The first error of writing to stdout, as errno says it; 0 before there is one.
int first_error = 0;

void note_error() {
  if (first_error == 0) first_error = errno != 0 ? errno : EIO;
}

void write_out(std::string_view text) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) note_error();
}

}  // namespace

void hold_standard_descriptors() {
  // open() takes the lowest free number, that of the closed one. What stands in for stdin is opened
  // to write and for stdout to read, so that using it is still an error.
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(descriptor, F_GETFD) < 0) {
      const int flags = descriptor == STDOUT_FILENO ? O_RDONLY : O_WRONLY;
      [[maybe_unused]] const int taken = open("/dev/null", flags);
    }
}

void print_lines(std::string_view text) {
  write_out(printable_lines(text));
}

void complain_lines(std::string_view text) {
  std::fflush(stdout);
  write_to_stderr(printable_lines(text));
}

void print_data(std::string_view text) {
  isatty(STDOUT_FILENO) == 1 ? print_lines(text) : write_out(text);
}

void print_as_is(std::string_view text) {
  write_out(text);
}

int PrintableStream::overflow(int character) {
  const char single = static_cast<char>(character);
  return xsputn(&single, 1) == 1 ? character : EOF;
}

std::streamsize PrintableStream::xsputn(const char* text, std::streamsize size) {
  line_.append(text, static_cast<std::size_t>(size));
  const std::size_t whole = line_.rfind('\n') + 1;  // npos + 1 = 0: no whole line yet
  print_lines(std::string_view(line_).substr(0, whole));
  line_.erase(0, whole);
  if (whole > 0 && std::fflush(stdout) != 0) note_error();
  return size;
}

int checked_output(int exit_code) {
  errno = 0;
  std::cout.flush();
  if (!std::cout) note_error();
  errno = 0;
  if (std::fflush(stdout) != 0) note_error();
  if (std::ferror(stdout) != 0) note_error();
  if (first_error == 0) return exit_code;
  write_to_stderr(
      fmt::format("campaign: standard output cannot be written ({}): what was printed "
                  "is incomplete; make room or open it, then ask again\n",
                  std::strerror(first_error)));
  return exit_code == exit_complete ? exit_failed : exit_code;
}

void write_to_stderr(std::string_view text) noexcept {
  while (!text.empty()) {
    const ssize_t written = write(STDERR_FILENO, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

}  // namespace haff::campaign
