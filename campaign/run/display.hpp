// SPDX-License-Identifier: GPL-3.0-or-later

// What a run shows of itself on stderr: a bar for each worker where stderr is a terminal, a plain
// line from time to time where it is a file or a pipe. Log lines go through here too, so that
// they and the bars do not write over each other. No function here throws when the terminal is
// gone: a run goes on unseen until SIGHUP stops it in order.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "campaign/job/report.hpp"

namespace haff::campaign {

// The campaign as a whole.
struct Totals {
  std::size_t jobs = 0;
  std::size_t done = 0;
  std::size_t failed = 0;
  double fraction = 0;                 // of all work, 0 ... 1
  std::optional<double> seconds_left;  // nothing before there is a speed
};

class Display {
 public:
  explicit Display(std::size_t workers);
  ~Display();  // leaves a clean line

  void set(std::size_t worker, std::optional<ProgressReport> report);
  void log(LogReport::Level level, const std::string& text);

  // Whether it is time to show the totals again.
  bool is_due() const;
  void show(const Totals& totals);

 private:
  void draw_bars(const Totals& totals);
  void write_line(const Totals& totals) const;
  void erase_bars();

  bool terminal_;
  std::vector<std::optional<ProgressReport>> workers_;
  std::size_t lines_drawn_ = 0;
  std::chrono::steady_clock::time_point shown_;
};

// The lines of one picture, each of at most `width` characters: one for each worker and one for the
// whole. Where this is more than `height` lines, only the one for the whole.
std::vector<std::string> bars(const std::vector<std::optional<ProgressReport>>& workers,
                              const Totals& totals, std::size_t width, std::size_t height);
// The same in one line.
std::string plain_line(const std::vector<std::optional<ProgressReport>>& workers,
                       const Totals& totals);

}  // namespace haff::campaign
