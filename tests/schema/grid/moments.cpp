// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/grid/moments.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

using namespace haff::schema;

namespace {

std::vector<double> through(const Moments& moments, double end) {
  std::vector<double> all;
  for (double moment = moments.next(-1); moment <= end; moment = moments.next(moment))
    all.push_back(moment);
  return all;
}

}  // namespace

TEST_CASE("moments: listed ones come one after the other") {
  const Moments moments{.listed = {0, 0.5, 20}};
  CHECK(through(moments, 100) == std::vector<double>{0, 0.5, 20});
  CHECK(moments.next(0.4) == 0.5);
  CHECK(moments.next(20) == std::numeric_limits<double>::infinity());
  CHECK(Moments().next(-1) == std::numeric_limits<double>::infinity());
  CHECK(Moments().empty());
}

TEST_CASE("moments: a number per decade, with four digits") {
  CHECK(through({.per_decade = 4, .from = 0.1}, 10) ==
        std::vector<double>{0.1, 0.1778, 0.3162, 0.5623, 1, 1.778, 3.162, 5.623, 10});
  CHECK(through({.per_decade = 3, .from = 0.2}, 3) ==
        std::vector<double>{0.2154, 0.4642, 1, 2.154});
  CHECK(through({.per_decade = 1, .from = 1e-3}, 1e9).size() == 13);
}

TEST_CASE(
    "moments: they are in order for all decades and numbers per decade, from the given start") {
  for (int per_decade = 1; per_decade <= most_per_decade; ++per_decade) {
    const Moments moments{.per_decade = per_decade, .from = 1e-6};
    const auto all = through(moments, 1e6);
    CHECK(all.size() == static_cast<std::size_t>(12 * per_decade + 1));
    CHECK(all.front() == 1e-6);
    CHECK(all.back() == 1e6);
    for (std::size_t k = 1; k < all.size(); ++k) {
      CHECK(all[k] > all[k - 1]);
      CHECK(moments.next(std::nextafter(all[k], 0.0)) == all[k]);
      // Four digits are exact to half a unit in the fourth.
      CHECK(std::abs(std::log10(all[k] / all[k - 1]) * per_decade - 1) < 0.05);
    }
  }
}

TEST_CASE("moments: a text of moments is read back") {
  for (const char* text : {R"({"tau":[0.5,2]})", R"({"tau":{"from":0.1,"log":20}})",
                           R"({"time":[1e+20]})", R"({"tau":[0],"time":{"from":0.01,"log":3}})"}) {
    CAPTURE(text);
    CHECK(schedule_text(schedule_in(text)) == text);
  }
  CHECK(Schedule().empty());
  for (const char* text :
       {"[1,2]", R"({"tau":[2,1]})", R"({"tau":[1,1]})", R"({"tau":[-1]})", R"({"tau":["x"]})",
        R"({"tau":{"log":20}})", R"({"tau":{"from":0,"log":20}})", R"({"tau":{"from":1,"log":0}})",
        R"({"tau":{"from":1,"log":101}})", R"({"tau":[1],"t":[2]})", "{", R"({"tau":[1e999]})"}) {
    CAPTURE(text);
    // The text is either refused or not the canonical one.
    bool is_refused = false;
    try {
      is_refused = schedule_text(schedule_in(text)) != text;
    } catch (const std::exception&) {
      is_refused = true;
    }
    CHECK(is_refused);
  }
}
