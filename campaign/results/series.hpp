// SPDX-License-Identifier: GPL-3.0-or-later

// Series: cooling jobs that differ only in their seed, with their results so far.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "schema/store/store.hpp"

namespace haff::campaign {

struct Series {
  schema::Job job;  // of its first realization
  int planned = 0;  // realizations
  int done = 0;
  double tau = 0;  // reached by the realization furthest behind
  double tau_max = 0;
  int reached = 0;                   // done realizations that reached tau_c
  std::optional<double> tau_c = {};  // mean over those
  std::optional<double> tau_c_se = {};
  std::optional<double> published_tau_c = {};
};

std::vector<Series> series_of(const schema::Reader& store);

// The table of tau_c beside what is published.
std::string series_table(const std::vector<Series>& series);

}  // namespace haff::campaign
