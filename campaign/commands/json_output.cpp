// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/commands/json_output.hpp"

#include <nlohmann/json.hpp>

#include "campaign/base/output/output.hpp"

namespace haff::campaign {

using nlohmann::ordered_json;

std::string indented_json(const ordered_json& value) {
  return value.dump(2, ' ', false, ordered_json::error_handler_t::replace) + '\n';
}

std::string one_line_json(const ordered_json& value) {
  return value.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + '\n';
}

void print_json(const ordered_json& value) {
  print_data(indented_json(value));
}

std::string error_json(const std::string& message, int exit_code) {
  return one_line_json({{"error", message}, {"exit_code", exit_code}});
}

}  // namespace haff::campaign
