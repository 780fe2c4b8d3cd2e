// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/commands/choosing.hpp"

#include <fmt/format.h>

#include "campaign/base/text/command_text.hpp"

namespace haff::campaign {

schema::Choice choice_of(const schema::Reader& store, const std::string& where,
                         const std::string& order) {
  schema::Choice choice(store, where, order);
  if (!where.empty() && chosen_jobs(store, choice).empty())
    throw schema::QueryError(fmt::format(
        "--where \"{}\": this is true of no job; to see what there is: {}", where,
        command_text("query \"SELECT job_id, kind, d, e, n, particles, seed, status FROM jobs\"",
                     store.path())));
  return choice;
}

}  // namespace haff::campaign
