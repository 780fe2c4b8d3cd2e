// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/results/mixed_physics.hpp"

#include <fmt/format.h>

#include "campaign/base/text/job_text.hpp"

namespace haff::campaign {

std::vector<std::string> mixed_physics(const schema::Reader& store) {
  std::vector<std::string> sentences;
  schema::Query rows =
      store.query("SELECT job_id, realizations, physics_versions FROM mixed_physics");
  while (const auto row = rows.next())
    sentences.push_back(fmt::format(
        "the {} realizations of the series of job {} ({}) were computed with physics versions {}, "
        "whose trajectories differ in their bits: averages over them mix the two",
        std::get<std::int64_t>((*row)[1]), std::get<std::int64_t>((*row)[0]),
        describe(store.job(std::get<std::int64_t>((*row)[0])).job),
        std::get<std::string>((*row)[2])));
  return sentences;
}

}  // namespace haff::campaign
