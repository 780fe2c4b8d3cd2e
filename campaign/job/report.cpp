// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/job/report.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <climits>
#include <nlohmann/json.hpp>

namespace haff::campaign {
namespace {

using nlohmann::json;

json to_json(const ProgressReport& report) {
  return {{"job_id", report.job_id},
          {"job", report.job},
          {"tau", report.tau},
          {"tau_max", report.tau_max},
          {"collisions_per_second", report.collisions_per_second}};
}

json to_json(const IdleReport&) {
  return {{"idle", true}};
}

json to_json(const LogReport& report) {
  json object{
      {"level", static_cast<int>(report.level)}, {"text", report.text}, {"event", report.event}};
  if (report.job_id) object["job_id"] = *report.job_id;
  return object;
}

}  // namespace

std::string to_line(const Report& report) {
  const json object = std::visit([](const auto& kind) { return to_json(kind); }, report);
  return object.dump(-1, ' ', true, json::error_handler_t::replace) + '\n';
}

std::optional<Report> report_from_line(std::string_view line) {
  const json object = json::parse(line, nullptr, false);
  if (!object.is_object()) return std::nullopt;
  if (object.contains("idle")) return IdleReport{};
  if (object.contains("text")) {
    LogReport report{static_cast<LogReport::Level>(object.value("level", 1)),
                     object.value("text", ""), object.value("event", "message")};
    if (object.contains("job_id")) report.job_id = object.value("job_id", std::int64_t{0});
    return report;
  }
  return ProgressReport{object.value("job_id", std::int64_t{0}), object.value("job", ""),
                        object.value("tau", 0.0), object.value("tau_max", 0.0),
                        object.value("collisions_per_second", 0.0)};
}

Reporter::Reporter(int file_descriptor) : file_descriptor_(file_descriptor) {
  fcntl(file_descriptor_, F_SETFL, fcntl(file_descriptor_, F_GETFL) | O_NONBLOCK);
}

void Reporter::send(const Report& report) const {
  const std::string line = to_line(report);
  // Lines up to PIPE_BUF arrive whole or not at all (pipe(7)).
  if (line.size() <= PIPE_BUF) [[maybe_unused]]
    const auto written = write(file_descriptor_, line.data(), line.size());
}

}  // namespace haff::campaign
