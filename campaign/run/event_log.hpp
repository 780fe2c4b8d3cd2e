// SPDX-License-Identifier: GPL-3.0-or-later

// What happens in a run, for programs: a line of JSON an event, appended to a file
// (`run --log-json FILE`). The events are described in campaign/README.md.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string_view>

namespace haff::campaign {

class EventLog {
 public:
  EventLog() = default;  // writes nothing
  ~EventLog();
  EventLog(const EventLog&) = delete;
  EventLog& operator=(const EventLog&) = delete;

  // From here on appends to the file, which is made if it is not there. Throws std::runtime_error.
  void open(const std::filesystem::path& file);
  bool is_open() const { return descriptor_ >= 0; }

  // {"time": ..., "event": ..., and the fields}. Each line is written whole, by one call, so that
  // several runs may share a file. When the file cannot be written any more, a message on stderr
  // says so once, and the run goes on without it.
  void add(std::string_view event, const nlohmann::ordered_json& fields);

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

}  // namespace haff::campaign
