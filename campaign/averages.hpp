// Averages over realizations, as the figures need them: the store's views mean_series and
// mean_tau_c in memory, for smooth spheres with constant restitution in three dimensions.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "schema/store.hpp"

namespace haff::campaign {

// A mean over realizations and its standard error, one a sample; NaN where there is none.
struct Means {
  std::vector<double> value, error;
};

// The mean series of one gas. Units as in the table samples.
struct MeanSeries {
  double e = 0;
  double n = 0;
  std::int64_t particles = 0;
  double sample_every = 0;
  std::vector<std::int64_t> realizations = {};  // that have this sample
  std::vector<double> tau = {};
  Means temperature = {}, gamma_ratio = {}, a2 = {}, a3 = {}, a4 = {};

  std::int64_t most_realizations() const;
};

struct MeanTauC {
  double e = 0;
  double n = 0;
  std::int64_t particles = 0;
  std::int64_t realizations = 0;
  std::int64_t reached = 0;  // realizations that got to tau_c
  double tau_c = 0;
  double error = 0;  // NaN for one realization
};

struct Averages {
  std::vector<MeanSeries> series;  // by n, particles, e
  std::vector<MeanTauC> tau_c;
};

Averages read_averages(const schema::Reader& store);

// What a figure draws at density n: for each inelastic e one series that has the observable, of
// the largest N there is, then of most realizations, then the longest. By increasing e.
using Observable = Means MeanSeries::*;
std::vector<MeanSeries> choose_series(const Averages& averages, double n, Observable observable);

// Of these, the one whose e is nearest to the wanted. There must be one.
const MeanSeries& nearest(const std::vector<MeanSeries>& series, double e);

// Likewise tau_c: for each inelastic e that reached it, of the largest N, then most realizations.
std::vector<MeanTauC> choose_tau_c(const Averages& averages, double n);

}  // namespace haff::campaign
