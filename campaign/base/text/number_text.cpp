// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/base/text/number_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace haff::campaign {
namespace {

std::string two_decimals(double value) {
  const std::string two = fmt::format("{:.2f}", value), more = fmt::format("{:.6g}", value);
  return more.size() > two.size() ? more : two;
}

bool has_size(double error) {
  return std::isfinite(error) && error > 0;
}

int decimals(double error) {
  constexpr int most = 12;
  return std::clamp(1 - static_cast<int>(std::floor(std::log10(error))), 0, most);
}

}  // namespace

std::string number_text(double value) {
  return fmt::format("{}", value);
}

std::optional<double> number_in(std::string_view text) {
  double number = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stop != end || !std::isfinite(number)) return std::nullopt;
  return number;
}

std::string value_text(double value, double error) {
  if (!has_size(error)) return fmt::format("{:.5g}", value);
  return fmt::format("{:.{}f}", value, decimals(error));
}

std::string value_with_error(double value, double error) {
  if (!has_size(error)) return value_text(value, error);
  return fmt::format("{} ± {:.{}f}", value_text(value, error), error, decimals(error));
}

std::string count_text(long long count) {
  std::string digits = std::to_string(count);
  const std::size_t first = digits.starts_with('-') ? 1 : 0;
  for (std::size_t place = digits.size(); place > first + 3;) {
    place -= 3;
    digits.insert(place, 1, ' ');
  }
  return digits;
}

std::string bytes_text(double bytes) {
  constexpr std::array units{"B", "kB", "MB", "GB", "TB"};
  std::size_t unit = 0;
  for (; bytes >= 999.5 && unit + 1 < units.size(); ++unit) bytes /= 1000;
  return fmt::format("{:.3g} {}", bytes, units[unit]);
}

std::string restitution_text(double e) {
  return two_decimals(e);
}

std::string density_text(double n) {
  return two_decimals(n);
}

}  // namespace haff::campaign
