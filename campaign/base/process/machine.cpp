// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/base/process/machine.hpp"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace haff::campaign {
namespace {

// A particle's record, its place in cells and queue, and its share of a state that is being stored:
// the least memory that a run needs at any density. [bytes]
constexpr double least_bytes_per_particle = 200;

// The processors of the affinity mask.
std::optional<int> affinity() {
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof(set), &set) != 0) return std::nullopt;
  return CPU_COUNT(&set);
}

// A quota of `microseconds` of CPU time in each `period` as a number of processors, rounded up.
std::optional<int> processors_of(double microseconds, double period) {
  if (!(microseconds > 0 && period > 0)) return std::nullopt;
  return static_cast<int>(std::ceil(microseconds / period));
}

// cpu.max of cgroup version 2: "150000 100000", or "max 100000" where there is no quota.
std::optional<int> quota_2(const std::filesystem::path& group) {
  std::ifstream file(group / "cpu.max");
  double quota = 0, period = 0;
  if (!(file >> quota >> period)) return std::nullopt;
  return processors_of(quota, period);
}

// The quota of version 1; -1 where there is none.
std::optional<int> quota_1(const std::filesystem::path& group) {
  double quota = 0, period = 0;
  std::ifstream(group / "cpu.cfs_quota_us") >> quota;
  std::ifstream(group / "cpu.cfs_period_us") >> period;
  return processors_of(quota, period);
}

// The folders of this process's cgroups and of those that hold them, with their version.
// /proc/self/cgroup has lines "0::/path" for version 2 and "4:cpu,cpuacct:/path" for version 1.
struct Group {
  std::filesystem::path folder;
  bool is_2;
};

std::vector<Group> groups_of(const std::string& controller) {
  const std::filesystem::path root = "/sys/fs/cgroup";
  std::vector<Group> groups;
  std::ifstream file("/proc/self/cgroup");
  for (std::string line; std::getline(file, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const bool is_2 = controllers.empty();
    if (!is_2 && controllers.find(controller) == std::string::npos) continue;
    const auto base = is_2 ? root : root / controllers;
    for (std::filesystem::path group = line.substr(second + 1);; group = group.parent_path()) {
      groups.push_back({base / group.relative_path(), is_2});
      if (!group.has_relative_path()) break;
    }
  }
  return groups;
}

std::optional<int> quota() {
  std::optional<int> least;
  for (const auto& [folder, is_2] : groups_of("cpu"))
    if (const auto found = is_2 ? quota_2(folder) : quota_1(folder))
      least = std::min(least.value_or(*found), *found);
  return least;
}

}  // namespace

int processors() {
  const int mask = affinity().value_or(static_cast<int>(std::thread::hardware_concurrency()));
  return std::max(1, std::min(mask, quota().value_or(mask)));
}

double memory_bytes() {
  double least =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  for (const auto& [folder, is_2] : groups_of("memory")) {
    std::ifstream file(folder / (is_2 ? "memory.max" : "memory.limit_in_bytes"));
    double limit = 0;
    if (file >> limit && limit > 0) least = std::min(least, limit);  // "max" is no number
  }
  return least;
}

schema::Memory machine_memory() {
  return {.bytes = memory_bytes(), .bytes_per_particle = least_bytes_per_particle};
}

}  // namespace haff::campaign
