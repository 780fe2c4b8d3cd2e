// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/run/process.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>

namespace haff::campaign {
namespace {

std::string host_name() {
  std::array<char, 256> name{};
  if (gethostname(name.data(), name.size() - 1) != 0) return "unknown";
  return name.data();
}

std::string boot_id() {
  std::string id = "unknown";
  std::ifstream("/proc/sys/kernel/random/boot_id") >> id;
  return id;
}

// Containers of one host share its boot id, but each counts its own processes.
std::string id_space() {
  std::array<char, 64> space{};
  if (readlink("/proc/self/ns/pid", space.data(), space.size() - 1) < 0) return "unknown";
  return space.data();
}

struct Stat {
  bool alive = false;
  std::int64_t start = 0;  // clock ticks since boot
};

// Fields 3 and 22 of proc(5). A process that has ended and was not yet reaped still has a start,
// but is not alive.
Stat stat_of(std::int64_t id) {
  std::ifstream file(fmt::format("/proc/{}/stat", id));
  std::string line;
  std::getline(file, line);
  // The name, field 2, may hold anything, brackets and blanks too: count from its end.
  const std::size_t name_end = line.rfind(')');
  if (name_end == std::string::npos) return {};
  std::istringstream fields(line.substr(name_end + 1));
  std::string state;
  fields >> state;
  std::string skipped;
  for (int field = 4; field < 22; ++field) fields >> skipped;
  std::int64_t start = 0;
  fields >> start;
  return {.alive = fields && state != "Z" && state != "X", .start = start};
}

}  // namespace

schema::Owner this_process() {
  return child_process(getpid());
}

schema::Owner child_process(pid_t id) {
  return {.host = host_name(),
          .boot_id = boot_id() + '/' + id_space(),
          .pid = id,
          .started = stat_of(id).start};
}

Life life_of(const schema::Owner& process) {
  if (process.host != host_name()) return Life::unknown;
  const std::string_view boot_and_space = process.boot_id;
  if (!boot_and_space.starts_with(boot_id() + '/')) return Life::dead;  // restarted since
  if (!boot_and_space.ends_with('/' + id_space())) return Life::unknown;
  const Stat now = stat_of(process.pid);
  return now.alive && now.start == process.started ? Life::alive : Life::dead;
}

}  // namespace haff::campaign
