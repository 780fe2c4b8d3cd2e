// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/job/report.hpp"

#include <doctest/doctest.h>
#include <unistd.h>

#include <array>

using namespace haff::campaign;

TEST_CASE("report: progress is sent and read") {
  const auto line = to_line(ProgressReport{7, "cooling e=0.8", 12.5, 90, 1.25e6});
  const auto report = report_from_line(line);
  REQUIRE(report);
  const auto& progress = std::get<ProgressReport>(*report);
  CHECK(progress.job_id == 7);
  CHECK(progress.job == "cooling e=0.8");
  CHECK(progress.tau == 12.5);
  CHECK(progress.tau_max == 90);
  CHECK(progress.collisions_per_second == 1.25e6);
}

TEST_CASE("report: a log message with quotes and line ends is one line") {
  const auto line = to_line(LogReport{LogReport::Level::error, "a \"b\"\nc", "job_failed", 7});
  CHECK(line.find('\n') == line.size() - 1);
  const auto report = report_from_line(line);
  REQUIRE(report);
  CHECK(std::get<LogReport>(*report).text == "a \"b\"\nc");
  CHECK(std::get<LogReport>(*report).level == LogReport::Level::error);
  CHECK(std::get<LogReport>(*report).event == "job_failed");
  CHECK(std::get<LogReport>(*report).job_id == 7);
}

TEST_CASE("report: an idle report is sent and read") {
  const auto report = report_from_line(to_line(IdleReport{}));
  REQUIRE(report);
  CHECK(std::holds_alternative<IdleReport>(*report));
}

TEST_CASE("report: an incomplete line is ignored") {
  CHECK_FALSE(report_from_line("{\"job_id\": 7, \"jo"));
}

TEST_CASE("report: a worker does not wait for a full pipe") {
  std::array<int, 2> ends{};
  REQUIRE(pipe(ends.data()) == 0);
  const Reporter reporter(ends[1]);
  for (int k = 0; k < 10'000; ++k) reporter.send(IdleReport{});  // 64 kB fit
  close(ends[0]);
  close(ends[1]);
}
