// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/commands/run/watch.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <thread>

#include "campaign/base/output/output.hpp"
#include "campaign/base/output/terminal.hpp"
#include "campaign/base/process/exit_code.hpp"
#include "campaign/base/process/signals.hpp"
#include "campaign/base/text/printable.hpp"

namespace haff::campaign {
namespace {

constexpr std::chrono::milliseconds look_for_signals{50};

// A screen of its own, which leaves what was on the terminal as it was.
constexpr std::string_view enter_screen = "\033[?1049h\033[?25l";
constexpr std::string_view leave_screen = "\033[?25h\033[?1049l";

bool write_all(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stdout);
  return std::fflush(stdout) == 0;
}

std::string time_of_day() {
  return fmt::format("{:%H:%M:%S}", fmt::localtime(std::time(nullptr)));
}

// Writes over what is there, so that nothing flickers.
void draw(const std::string& text) {
  const TerminalSize size = terminal_size(STDOUT_FILENO);
  std::string picture = "\033[H";
  for (const std::string& line : screen_of(text, static_cast<std::size_t>(size.columns),
                                           static_cast<std::size_t>(std::max(size.lines - 1, 1))))
    picture += line + "\033[K\n";
  picture += fmt::format("{}; Ctrl-C ends this\033[K\033[J", time_of_day());
  write_all(picture);
}

// Leaves that screen however the watch ends.
class Screen {
 public:
  explicit Screen(bool is_terminal) : is_terminal_(is_terminal) {
    if (is_terminal_) write_all(enter_screen);
  }
  ~Screen() {
    if (is_terminal_) write_all(leave_screen);
  }
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

 private:
  bool is_terminal_;
};

void wait(double seconds) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (stop_signal() == 0 && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(look_for_signals);
}

}  // namespace

int watch(const std::function<std::string()>& make, double every_seconds, bool is_data) {
  note_stop_signals();
  const bool is_terminal = isatty(STDOUT_FILENO) == 1 && !is_data;
  std::string text;
  {
    const Screen screen(is_terminal);
    while (stop_signal() == 0) {
      text = make();
      if (is_terminal) {
        draw(text);
      } else {
        if (!is_data) say("---- {}\n", time_of_day());
        is_data ? print_data(text) : print_lines(text);
        if (std::fflush(stdout) != 0) break;
      }
      wait(every_seconds);
    }
  }
  if (is_terminal) print_lines(text);
  return exit_complete;
}

std::vector<std::string> screen_of(std::string_view text, std::size_t columns, std::size_t lines) {
  std::vector<std::string> all;
  const std::string safe = printable_lines(text);
  std::string line;
  std::size_t width = 0;
  for (const char character : safe) {
    if (character == '\n') {
      all.push_back(std::move(line));
      line.clear();
      width = 0;
      continue;
    }
    const bool begins = (static_cast<unsigned char>(character) & 0xC0U) != 0x80U;  // UTF-8
    if (begins) ++width;
    if (width <= columns) line += character;
  }
  if (!line.empty()) all.push_back(std::move(line));
  if (all.size() > lines) {
    const std::size_t hidden = all.size() - (lines - 1);
    all.resize(lines - 1);
    all.push_back(fmt::format("... {} more lines", hidden));
  }
  return all;
}

}  // namespace haff::campaign
