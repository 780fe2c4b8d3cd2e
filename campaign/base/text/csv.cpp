// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/base/text/csv.hpp"

#include <fmt/format.h>

#include <cmath>

namespace haff::campaign {

std::string csv_field(double value) {
  return std::isfinite(value) ? fmt::format("{:.17g}", value) : "";
}

std::string csv_field(std::string_view text) {
  if (!text.empty() && text.find_first_of(",\"\r\n") == std::string_view::npos)
    return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string csv_line(const std::vector<std::string>& fields) {
  return fmt::format("{}\n", fmt::join(fields, ","));
}

}  // namespace haff::campaign
