// SPDX-License-Identifier: GPL-3.0-or-later

// Averages over realizations, as the figures need them: the store's view mean_series in memory,
// with the realizations it averages, for smooth spheres with constant restitution in three
// dimensions, and for the same with their velocities shuffled.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "analysis/statistics/statistics.hpp"
#include "schema/store/store.hpp"

namespace haff::campaign {

// Means over realizations, one a sample, and their errors: half the 68 % interval of the mean by
// Student's t, which is larger than the standard error by 1.84, 1.32, 1.20 for 2, 3, 4
// realizations, since a standard error of so few values is too uncertain to be drawn.
// Neighbouring samples are correlated. NaN where there is none.
struct Means {
  std::vector<double> value, error;
};

// Such an error, from the standard error over this many realizations. NaN for one.
double bar(double standard_error, std::int64_t realizations);

// The same for a mean over `velocities` independent velocities of all realizations together. That
// of the Laguerre coefficient of this order (0 for everything else) is never less than that of
// Gaussian velocities.
double error_of_mean(int laguerre, double standard_error, std::int64_t realizations,
                     double velocities, int d = 3);

// One finished run: for what is fitted, or drawn, realization by realization.
struct Realization {
  std::int64_t job_id = 0;
  std::uint64_t seed = 0;
  std::optional<double> tau_c = {};
  // Units as in the table samples; NaN where not measured.
  std::vector<double> tau = {}, temperature = {}, gamma_ratio = {}, a2 = {};
  std::vector<double> largest_cluster = {};
};

// A curve over realizations, names and units as in the table profiles.
struct MeanProfile {
  std::string name;
  double tau = 0;
  std::int64_t realizations = 0;
  std::vector<double> x = {};
  Means mean = {};
};

// The mean series of one gas. Units as in the table samples. All realizations are sampled at the
// same tau, after the same number of collisions: they are averaged as they are.
struct MeanSeries {
  double e = 0;
  double n = 0;
  std::int64_t particles = 0;
  double sample_every = 0;
  double equilibrate = 0;
  std::string effects = "{}";                   // as in the table jobs
  std::optional<double> shuffled_every = {};    // [tau]
  std::vector<std::int64_t> realizations = {};  // that have this sample
  std::vector<double> tau = {};
  Means temperature = {}, gamma_ratio = {};
  // Their errors are known beforehand where velocities are nearly Gaussian
  // (analysis/observables/moments.hpp): never less than that, and that where there is one
  // realization.
  Means a2 = {}, a3 = {}, a4 = {};
  std::vector<MeanProfile> profiles = {};    // by name, then tau
  std::vector<Realization> runs = {};        // by seed
  std::int64_t missing = 0;                  // realizations planned, but not done
  std::set<std::string> code_versions = {};  // of the programs that made them

  std::int64_t most_realizations() const;
  // The profile of this name whose tau is nearest; null if there is none of the name.
  const MeanProfile* profile(const std::string& name, double at) const;
};

// A velocity field of one realization, of the base case.
struct VelocityField {
  double e = 0;
  double n = 0;
  std::int64_t particles = 0;
  std::uint64_t seed = 0;
  double temperature = 0;  // of the gas at that tau [E(0)]
  std::string code_version = {};
  schema::Field field = {};
};

// tau_c of one gas, mean over the realizations that reached it.
struct MeanTauC {
  double e = 0;
  double n = 0;
  std::int64_t particles = 0;
  std::int64_t realizations = 0;
  std::int64_t reached = 0;  // where fewer than realizations, the others stopped before it
  double tau_c = 0;
  double error = 0;          // as in Means
  double half_interval = 0;  // of 95 %, by Student's t; NaN for one realization
  std::set<std::string> code_versions = {};
};

struct Averages {
  std::vector<MeanSeries> series;         // by n, particles, e
  std::vector<MeanSeries> shuffled = {};  // velocities shuffled; by e, n, particles, every
  std::optional<VelocityField> velocity_field = {};  // of figure 8, if the store has one
};

Averages read_averages(const schema::Reader& store);

// Nothing if no realization reached it.
std::optional<MeanTauC> mean_tau_c(const MeanSeries& series);

// The series that a figure draws at density n: for each inelastic e, among those that have the
// observable, the one with the most particles in all realizations together, then the longest. By
// increasing e.
using Observable = Means MeanSeries::*;
std::vector<MeanSeries> choose_series(const Averages& averages, double n, Observable observable);

// Likewise at restitution e: for each density one series, by increasing n.
std::vector<MeanSeries> choose_densities(const Averages& averages, double e, Observable observable);

// Likewise those that have profiles of this name.
std::vector<MeanSeries> choose_profiles(const Averages& averages, double n,
                                        const std::string& name);

// The series of these with the nearest e. There must be one.
const MeanSeries& nearest(const std::vector<MeanSeries>& series, double e);

// Likewise tau_c: for each inelastic e the one of the most particles in all that reached it.
std::vector<MeanTauC> choose_tau_c(const Averages& averages, double n);

}  // namespace haff::campaign
