// SPDX-License-Identifier: GPL-3.0-or-later

// The table of tau_c that `status` prints, and `run` at its end.
#include "campaign/results/series.hpp"

#include <doctest/doctest.h>

using namespace haff::campaign;

TEST_CASE("series: the table says how early tau_c may be where rows are far apart") {
  const auto table = [](double sample_every) {
    Series series;
    series.planned = series.done = series.reached = 1;
    series.tau = series.tau_max = 70;
    series.tau_c = 57.6;
    series.job.e = 0.8;
    series.job.sample_every = sample_every;
    return series_table({series});
  };
  const char* note = "comes out early by up to sample_every^2/(2 tau_c)";
  CHECK(table(10).find(note) != std::string::npos);  // early by up to 0.87; 0.41 was measured
  CHECK(table(2).find(note) != std::string::npos);   // 0.03
  CHECK(table(1).find(note) == std::string::npos);   // 0.009
}
