#include "campaign/base/machine.hpp"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <thread>

namespace haff::campaign {
namespace {

// A particle's record, its place in cells and calendar, and its share of a state being stored:
// the least a run can do with, whatever the density. [bytes]
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

// cpu.max of cgroup version 2: "150000 100000", or "max 100000" where there is none.
std::optional<int> quota_2(const std::filesystem::path& group) {
  std::ifstream file(group / "cpu.max");
  double quota = 0, period = 0;
  if (!(file >> quota >> period)) return std::nullopt;
  return processors_of(quota, period);
}

// Of version 1; -1 where there is none.
std::optional<int> quota_1(const std::filesystem::path& group) {
  double quota = 0, period = 0;
  std::ifstream(group / "cpu.cfs_quota_us") >> quota;
  std::ifstream(group / "cpu.cfs_period_us") >> period;
  return processors_of(quota, period);
}

// The least quota of this process's cgroups and of those that hold them. /proc/self/cgroup has
// lines "0::/path" for version 2 and "4:cpu,cpuacct:/path" for version 1.
std::optional<int> quota() {
  const std::filesystem::path root = "/sys/fs/cgroup";
  std::optional<int> least;
  std::ifstream file("/proc/self/cgroup");
  for (std::string line; std::getline(file, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const bool is_2 = controllers.empty();
    if (!is_2 && controllers.find("cpu") == std::string::npos) continue;
    const auto base = is_2 ? root : root / controllers;
    for (std::filesystem::path group = line.substr(second + 1);; group = group.parent_path()) {
      const auto here = base / group.relative_path();
      if (const auto found = is_2 ? quota_2(here) : quota_1(here))
        least = std::min(least.value_or(*found), *found);
      if (!group.has_relative_path()) break;
    }
  }
  return least;
}

}  // namespace

int processors() {
  const int mask = affinity().value_or(static_cast<int>(std::thread::hardware_concurrency()));
  return std::max(1, std::min(mask, quota().value_or(mask)));
}

schema::Memory machine_memory() {
  const double pages = static_cast<double>(sysconf(_SC_PHYS_PAGES));
  return {.bytes = pages * static_cast<double>(sysconf(_SC_PAGESIZE)),
          .bytes_per_particle = least_bytes_per_particle};
}

}  // namespace haff::campaign
