// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/base/text/error_text.hpp"

#include <stdexcept>

#include "campaign/base/text/command_text.hpp"
#include "schema/error.hpp"

namespace haff::campaign {
namespace {

std::string advice(const schema::StoreError& error) {
  const auto type = [&error](const char* command) { return command_text(command, error.store); };
  switch (error.remedy) {
    case schema::Remedy::none:
      return "";
    case schema::Remedy::name_a_store:
      return "; name a store with --store FILE";
    case schema::Remedy::plan:
      return "; make it with: " + type("plan GRID.json");
    case schema::Remedy::check:
      return "; see: " + type("verify");
    case schema::Remedy::repair:
      return "; see: " + type("verify --repair");
    case schema::Remedy::upgrade:
      return "; bring it forward with: " + type("upgrade");
    case schema::Remedy::back_up:
      return "; make it with: " + type("backup FILE");
  }
  throw std::logic_error("unknown remedy");
}

}  // namespace

std::string error_text(const std::exception& error) {
  const auto* of_store = dynamic_cast<const schema::StoreError*>(&error);
  return of_store == nullptr ? error.what() : error.what() + advice(*of_store);
}

}  // namespace haff::campaign
