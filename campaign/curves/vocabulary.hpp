// SPDX-License-Identifier: GPL-3.0-or-later

// The words that a question about a store may use, and how its SQL is made of them.
//
// A user writes a2, roughness.beta, N or tau; SQL has columns of samples, values within the JSON of
// effects, and the column particles. SQLite ignores case, so N alone would be the density n.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "schema/store/store.hpp"

namespace haff::campaign {

struct Vocabulary {
  std::vector<std::string> columns;     // of samples, with those that follow from them (derived)
  std::vector<std::string> profiles;    // names of profiles that finished runs have
  std::vector<std::string> parameters;  // d, e, n, N, ..., roughness.beta, ...
};

Vocabulary vocabulary_of(const schema::Reader& store);

// Quantities that are one number of each run, by their names: tau_c, a2, gamma_ratio, ...
std::vector<std::string> quantity_names();

// Quantities that follow from the columns of a sample, and are used like columns.
struct DerivedColumn {
  std::string_view name;
  std::string sql;
  std::string_view meaning;
};
extern const std::vector<DerivedColumn> derived_columns;

// The variable of a profile as the axis calls it (schema/grid/observables.hpp): c, r, k ...; x of
// one that this program does not know.
std::string profile_variable(std::string_view profile);

// The user's SQL with N as particles and parameters of effects as columns of the rows below.
std::string translated(const std::string& sql, const Vocabulary& words);

// Whether an expression in columns of samples is an average over the interval before its sample, as
// decay rate, collision rate and pressure are; and an expression in tau and time at the middle of
// that interval.
bool is_of_interval(std::string_view sql);
std::string at_middles(const std::string& sql);

// Rows to select from, a SELECT in brackets: of all finished cooling jobs, one a job with all its
// parameters, one a sample, or one a point of this profile.
std::string job_rows(const Vocabulary& words);
std::string sample_rows(const Vocabulary& words);
std::string profile_rows(const Vocabulary& words, const std::string& profile);

}  // namespace haff::campaign
