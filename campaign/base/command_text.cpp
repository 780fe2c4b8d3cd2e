#include "campaign/base/command_text.hpp"

namespace haff::campaign {

std::string command_text(const std::string& command, const std::filesystem::path& store) {
  if (store == default_store) return "campaign " + command;
  return "campaign " + command + " --store " + store.string();
}

}  // namespace haff::campaign
