// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/grid/moments.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "schema/grid/source.hpp"

namespace haff::schema {

namespace {

constexpr int logarithmic_digits = 4;  // of a logarithmic moment

// Moment k, 10^(k/per_decade). Its mantissa, from 1 to 10, never lies within 1e-8 of the middle
// between two numbers of four digits, so that the last digits of std::pow do not decide how it is
// rounded.
double logarithmic(int per_decade, int k) {
  const int decade = k >= 0 ? k / per_decade : -((per_decade - 1 - k) / per_decade);
  const double power = std::pow(10.0, static_cast<double>(k - decade * per_decade) / per_decade);
  std::array<char, 32> text;
  char* end = std::to_chars(text.data(), text.data() + text.size(), power, std::chars_format::fixed,
                            logarithmic_digits - 1)
                  .ptr;
  *end++ = 'e';
  end = std::to_chars(end, text.data() + text.size(), decade).ptr;
  double moment = 0;
  std::from_chars(text.data(), end, moment);
  return moment;
}

std::string axis_text(const Moments& moments) {
  if (moments.per_decade > 0)
    return R"({"from":)" + text(moments.from) + R"(,"log":)" + std::to_string(moments.per_decade) +
           "}";
  std::string list;
  for (const double moment : moments.listed) list += (list.empty() ? "" : ",") + text(moment);
  return "[" + list + "]";
}

// The moments are finite and not negative, so that a run meets them one after the other.
double moment_in(const Json& value) {
  const auto moment = value.get<double>();
  if (!(moment >= 0 && std::isfinite(moment)))
    throw std::invalid_argument("a moment is not a number of at least 0");
  return moment;
}

Moments axis_in(const Json& value) {
  Moments moments;
  if (value.is_array()) {
    for (const Json& item : value) moments.listed.push_back(moment_in(item));
    if (!std::ranges::is_sorted(moments.listed, std::less_equal{}))
      throw std::invalid_argument("moments do not increase");
    return moments;
  }
  moments.from = moment_in(value.at("from"));
  moments.per_decade = value.at("log").get<int>();
  if (!(moments.from > 0 && moments.per_decade > 0 && moments.per_decade <= most_per_decade))
    throw std::invalid_argument("no moments are so many a decade");
  return moments;
}

}  // namespace

double Moments::next(double after) const {
  if (per_decade == 0) {
    const auto found = std::ranges::upper_bound(listed, after);
    return found == listed.end() ? std::numeric_limits<double>::infinity() : *found;
  }
  const double least = std::max(from, after);
  if (!std::isfinite(least)) return std::numeric_limits<double>::infinity();
  // The rounded logarithm is off by one at most.
  int k = static_cast<int>(std::floor(std::log10(least) * per_decade)) - 1;
  const auto is_next = [&](double moment) { return moment >= from && moment > after; };
  while (!is_next(logarithmic(per_decade, k))) ++k;
  return logarithmic(per_decade, k);
}

std::string schedule_text(const Schedule& schedule) {
  std::string members;
  if (!schedule.tau.empty()) members += R"("tau":)" + axis_text(schedule.tau);
  if (!schedule.time.empty())
    members += (members.empty() ? "" : ",") + (R"("time":)" + axis_text(schedule.time));
  return "{" + members + "}";
}

Schedule schedule_in(const std::string& text) {
  const Json value = Json::parse(text);
  Schedule schedule;
  if (value.contains("tau")) schedule.tau = axis_in(value.at("tau"));
  if (value.contains("time")) schedule.time = axis_in(value.at("time"));
  return schedule;
}

}  // namespace haff::schema
