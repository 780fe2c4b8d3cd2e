#include "campaign/job_text.hpp"

#include <fmt/format.h>

namespace haff::campaign {

std::string describe(const schema::Job& job) {
  const std::string gas = fmt::format("n={} N={} seed {}", job.n, job.particles, job.seed);
  const std::string effects = job.effects == "{}" ? "" : " " + job.effects;
  return job.kind == schema::Kind::cooling ? fmt::format("cooling e={} {}{}", job.e, gas, effects)
                                           : "equilibration " + gas;
}

std::string number_text(double value) {
  return fmt::format("{}", value);
}

}  // namespace haff::campaign
