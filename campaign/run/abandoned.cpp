#include "campaign/run/abandoned.hpp"

#include <ctime>
#include <string>

#include "campaign/run/process.hpp"

namespace haff::campaign {
namespace {

// From UTC in ISO 8601, as the store writes it.
double seconds_since(const std::string& time) {
  std::tm parts{};
  if (strptime(time.c_str(), "%Y-%m-%dT%H:%M:%S", &parts) == nullptr) return 0;
  return std::difftime(std::time(nullptr), timegm(&parts));
}

}  // namespace

bool is_abandoned(const schema::RunningJob& job) {
  switch (life_of(job.owner)) {
    case Life::alive:
      return false;
    case Life::dead:
      return true;
    case Life::unknown:
      break;
  }
  return seconds_since(job.renewed) > lease_seconds;
}

}  // namespace haff::campaign
