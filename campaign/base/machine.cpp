#include "campaign/base/machine.hpp"

#include <unistd.h>

#include <algorithm>
#include <thread>

namespace haff::campaign {
namespace {

// A particle's record, its place in cells and calendar, and its share of a state being stored:
// the least a run can do with, whatever the density. [bytes]
constexpr double least_bytes_per_particle = 200;

}  // namespace

int processors() {
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

schema::Memory machine_memory() {
  const double pages = static_cast<double>(sysconf(_SC_PHYS_PAGES));
  return {.bytes = pages * static_cast<double>(sysconf(_SC_PAGESIZE)),
          .bytes_per_particle = least_bytes_per_particle};
}

}  // namespace haff::campaign
