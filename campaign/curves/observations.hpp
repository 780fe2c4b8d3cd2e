// SPDX-License-Identifier: GPL-3.0-or-later

// Values of the finished runs of a store, realization by realization, which are averaged into a
// curve, or are first subtracted seed by seed.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "campaign/accuracy/quantity.hpp"
#include "campaign/curves/scene.hpp"
#include "campaign/curves/vocabulary.hpp"

namespace haff::campaign {

struct Reading {
  double x = 0, y = 0;
};

// Of one scene: readings by place (tau of a sample, x of a profile, 0 of what is one number) and
// seed.
struct Observation {
  Scene scene;
  std::map<double, std::map<std::uint64_t, Reading>> readings;
};

struct Observations {
  std::vector<Observation> all = {};  // in the order of tables
  std::set<std::string> code_versions = {};
};

// A realization that was run again to observe more is one, as in the views of the store. `where` is
// a condition in SQL, empty for none; each throws schema::QueryError for SQL that is none.

// `y` against `x`, expressions in the columns of samples, at each tau. What is an average over the
// interval before its sample is read against the middle of the interval.
Observations samples_of(const schema::Reader& store, const Vocabulary& words, const std::string& y,
                        const std::string& x, const std::string& where);

// Their mean over the samples that `where` leaves of each run, against `x`, an expression in the
// parameters.
Observations means_of(const schema::Reader& store, const Vocabulary& words, const std::string& y,
                      const std::string& x, const std::string& where);

// A profile against its variable; the scenes have a tau.
Observations profiles_of(const schema::Reader& store, const Vocabulary& words,
                         const std::string& profile, const std::string& where);

// A quantity of accuracy/quantity.hpp against `x`, an expression in the parameters.
Observations quantities_of(const schema::Reader& store, const Vocabulary& words,
                           const Quantity& quantity, const std::string& x,
                           const std::string& where);

// A scene for each realization, with its seed among the parameters.
void part_by_seed(Observations& observations);

}  // namespace haff::campaign
