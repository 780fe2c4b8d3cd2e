// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/report/occupancy.hpp"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>

namespace haff::campaign {
namespace {

// A job shorter than the clock's resolution is spread over this. [s]
constexpr double shortest_job = 1e-3;

}  // namespace

double seconds_of(const std::string& utc) {
  int year = 0;
  unsigned month = 0, day = 0;
  int hour = 0, minute = 0;
  double second = 0;
  if (std::sscanf(utc.c_str(), "%4d-%2u-%2uT%2d:%2d:%lfZ", &year, &month, &day, &hour, &minute,
                  &second) != 6)
    return std::numeric_limits<double>::quiet_NaN();
  const std::chrono::sys_days date{std::chrono::year(year) / std::chrono::month(month) /
                                   std::chrono::day(day)};
  const auto days = static_cast<double>(date.time_since_epoch().count());
  return ((days * 24 + hour) * 60 + minute) * 60 + second;
}

std::vector<Occupancy> occupancy(const std::vector<schema::JobRow>& jobs,
                                 const std::vector<schema::RunningJob>& running) {
  std::map<std::int64_t, std::string> alive;
  for (const schema::RunningJob& job : running) alive[job.lease.job_id] = job.renewed;
  // How much the number of busy processors grows at each time, by host.
  std::map<std::string, std::map<double, double>> steps;
  for (const schema::JobRow& row : jobs) {
    if (!row.started || !row.host) continue;
    const auto sign_of_life = alive.find(row.job_id);
    if (!row.finished && sign_of_life == alive.end())
      continue;  // interrupted: its end is not known
    const double from = seconds_of(*row.started);
    const double to =
        std::max(seconds_of(sign_of_life == alive.end() ? *row.finished : sign_of_life->second),
                 from + shortest_job);
    if (!std::isfinite(from) || !std::isfinite(to)) continue;
    const double busy = row.progress.cpu_seconds / (to - from);
    steps[*row.host][from] += busy;
    steps[*row.host][to] -= busy;
  }
  std::vector<Occupancy> all;
  for (const auto& [host, changes] : steps) {
    Occupancy one{.host = host, .time = {}, .busy = {}};
    double busy = 0;
    for (const auto& [time, change] : changes) {
      busy += change;
      one.time.push_back(time);
      one.busy.push_back(std::max(0.0, busy));
    }
    all.push_back(std::move(one));
  }
  return all;
}

}  // namespace haff::campaign
