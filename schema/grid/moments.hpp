// SPDX-License-Identifier: GPL-3.0-or-later

// Moments at which a job does something, beside what it does at intervals: the keys sample_at and
// snapshots_at of a grid.
#pragma once

#include <string>
#include <vector>

namespace haff::schema {

// Moments on one axis, tau or time: those that are listed, or so many a decade.
//
// The logarithmic ones are 10^(k/per_decade) for whole k, with four digits: 1, 1.122, 1.259 ...
// Rounded to so few digits, they are the same doubles on every machine, whatever its C library
// makes of a power, and a user can type them.
struct Moments {
  std::vector<double> listed = {};  // increasing
  int per_decade = 0;               // 0: none
  double from = 0;                  // logarithmic ones begin at the first of at least this

  bool empty() const { return listed.empty() && per_decade == 0; }

  // The first moment after this one; infinity if there is none. After -1 comes the first of all.
  double next(double after) const;

  bool operator==(const Moments&) const = default;
};

struct Schedule {
  Moments tau;   // [collisions per particle]
  Moments time;  // since the start of cooling [sigma sqrt(m/E(0))]

  bool empty() const { return tau.empty() && time.empty(); }

  bool operator==(const Schedule&) const = default;
};

// {"tau":[0.5,2],"time":{"from":0.1,"log":20}}, as in the columns jobs.sample_at and
// jobs.snapshots_at: an axis without moments is left out. And back; throws std::invalid_argument or
// what nlohmann::json throws.
std::string schedule_text(const Schedule& schedule);
Schedule schedule_in(const std::string& text);

// More a decade than this would round two moments to the same four digits.
inline constexpr int most_per_decade = 100;

// Where logarithmic moments begin unless a grid says otherwise.
inline constexpr double usual_first_moment = 0.1;

}  // namespace haff::schema
