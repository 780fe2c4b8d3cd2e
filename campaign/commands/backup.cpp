#include "campaign/commands/backup.hpp"

#include "campaign/base/command_text.hpp"
#include "campaign/base/exit_code.hpp"
#include "campaign/base/number_text.hpp"
#include "campaign/base/output.hpp"
#include "schema/store.hpp"

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
