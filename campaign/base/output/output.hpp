// SPDX-License-Identifier: GPL-3.0-or-later

// Standard output: what is printed for people, and whether it arrived.
#pragma once

#include <fmt/format.h>

#include <ostream>
#include <streambuf>
#include <string>
#include <string_view>
#include <utility>

namespace haff::campaign {

// Opens a stand-in for each of stdin, stdout and stderr that the parent closed, so that no file of
// the program's own takes its number and is written over. Writing to a stdout that was closed still
// fails. To be called first.
void hold_standard_descriptors();

// Prints to stdout, with each line made printable (printable.hpp).
void print_lines(std::string_view text);

template <class... Values>
void say(fmt::format_string<Values...> format, Values&&... values) {
  print_lines(fmt::format(format, std::forward<Values>(values)...));
}

// The same to stderr, behind everything that was printed before.
void complain_lines(std::string_view text);

template <class... Values>
void complain(fmt::format_string<Values...> format, Values&&... values) {
  complain_lines(fmt::format(format, std::forward<Values>(values)...));
}

// Prints data for programs: unchanged into a file or a pipe, made printable on a terminal.
void print_data(std::string_view text);

// Prints text that was made printable part by part, with colours between the parts.
void print_as_is(std::string_view text);

// A stream whose lines go through print_lines, each as soon as it is whole.
class PrintableStream : private std::streambuf, public std::ostream {
 public:
  PrintableStream() : std::ostream(static_cast<std::streambuf*>(this)) {}
  ~PrintableStream() override { print_lines(line_); }

 private:
  int overflow(int character) override;
  std::streamsize xsputn(const char* text, std::streamsize size) override;

  std::string line_;
};

// Hands all that was printed to the operating system and returns the exit code: `exit_code`, or
// exit_failed in place of exit_complete when stdout could not be written (full disk, closed, pipe
// that nothing reads), with a message on stderr.
int checked_output(int exit_code);

// Writes to stderr, and never throws: when the terminal is gone, the text is lost.
void write_to_stderr(std::string_view text) noexcept;

}  // namespace haff::campaign
