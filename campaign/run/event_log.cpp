// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/run/event_log.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "campaign/base/output/output.hpp"

namespace haff::campaign {
namespace {

// UTC, as in the store: 2003-09-05T12:00:00.000Z.
std::string now_text() {
  using namespace std::chrono;
  const auto since_1970 = duration_cast<milliseconds>(system_clock::now().time_since_epoch());
  const std::time_t seconds = since_1970.count() / 1000;
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z", fmt::gmtime(seconds),
                     since_1970.count() % 1000);
}

}  // namespace

void EventLog::open(const std::filesystem::path& file) {
  file_ = file;
  descriptor_ = ::open(file.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0)
    throw std::runtime_error(
        fmt::format("{}: the log cannot be written: {}", file.string(), std::strerror(errno)));
}

EventLog::~EventLog() {
  if (is_open()) close(descriptor_);
}

void EventLog::add(std::string_view event, const nlohmann::ordered_json& fields) {
  if (!is_open()) return;
  nlohmann::ordered_json object{{"time", now_text()}, {"event", event}};
  object.update(fields);
  const std::string line =
      object.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
  ssize_t written = 0;
  do {
    written = write(descriptor_, line.data(), line.size());
  } while (written < 0 && errno == EINTR);
  if (written == static_cast<ssize_t>(line.size())) return;
  complain("campaign: {}: the log cannot be written any more ({}); the run goes on without it\n",
           file_.string(), written < 0 ? std::strerror(errno) : "the disk is full");
  close(descriptor_);
  descriptor_ = -1;
}

}  // namespace haff::campaign
