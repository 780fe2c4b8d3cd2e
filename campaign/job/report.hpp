// SPDX-License-Identifier: GPL-3.0-or-later

// What a worker tells its coordinator: one line of JSON a report, through a pipe.
//
// Progress goes this way, and reaches the store only every few seconds. A report that the
// coordinator is too busy to take is dropped: work never waits for it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace haff::campaign {

struct ProgressReport {
  std::int64_t job_id = 0;
  std::string job;  // in words
  double tau = 0;
  double tau_max = 0;
  double collisions_per_second = 0;
};

// The worker has no job at the moment.
struct IdleReport {};

struct LogReport {
  enum class Level { debug, info, warning, error };
  Level level = Level::info;
  std::string text;
  std::string event = "message";            // what happened, as in the log for programs
  std::optional<std::int64_t> job_id = {};  // to which job
};

using Report = std::variant<ProgressReport, IdleReport, LogReport>;

std::string to_line(const Report& report);
std::optional<Report> report_from_line(std::string_view line);

// The worker's end of the pipe.
class Reporter {
 public:
  explicit Reporter(int file_descriptor);
  void send(const Report& report) const;

 private:
  int file_descriptor_;
};

}  // namespace haff::campaign
