#include "campaign/base/number_text.hpp"

#include <fmt/format.h>

#include <array>

namespace haff::campaign {
namespace {

std::string two_decimals(double value) {
  const std::string two = fmt::format("{:.2f}", value), more = fmt::format("{:.6g}", value);
  return more.size() > two.size() ? more : two;
}

}  // namespace

std::string number_text(double value) {
  return fmt::format("{}", value);
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
