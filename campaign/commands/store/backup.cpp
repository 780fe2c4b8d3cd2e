// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/commands/store/backup.hpp"

#include "campaign/base/output/output.hpp"
#include "campaign/base/process/exit_code.hpp"
#include "campaign/base/text/command_text.hpp"
#include "campaign/base/text/number_text.hpp"
#include "schema/store/store.hpp"

namespace haff::campaign {

int back_up(const std::filesystem::path& store, const std::filesystem::path& to) {
  const schema::Reader reader(store);
  if (reader.lacks_log())
    complain("campaign: {}: its newest rows may be missing, as the log beside it is; see: {}\n",
             store.string(), command_text("verify", store));
  const auto bytes = reader.back_up(to);
  say("{}: {}, sound\n", to.string(), bytes_text(static_cast<double>(bytes)));
  return exit_complete;
}

}  // namespace haff::campaign
