// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/base/text/job_text.hpp"

#include <fmt/format.h>

#include "campaign/base/text/number_text.hpp"

namespace haff::campaign {

std::string describe(const schema::Job& job) {
  const std::string disks = job.d == 2 ? "d=2 " : "";
  const std::string gas = disks + fmt::format("n={} N={} seed {}", job.n, job.particles, job.seed);
  const std::string effects = job.effects.none() ? "" : " " + job.effects.text();
  const std::string start = job.start.is_uniform() ? "" : " start " + schema::start_text(job.start);
  if (job.kind == schema::Kind::equilibration)
    return (job.start.is_equilibrated() ? "equilibration " : "preparation ") + gas + start;
  const std::string e = job.e ? fmt::format("e={} ", *job.e) : "";
  return fmt::format("cooling {}{}{}{}", e, gas, effects, start);
}

std::string e_text(const schema::Job& job) {
  return job.e ? number_text(*job.e) : "-";
}

}  // namespace haff::campaign
