// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/results/averages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <tuple>
#include <utility>
#include <variant>

#include "analysis/observables/moments.hpp"
#include "analysis/statistics/accuracy.hpp"

namespace haff::campaign {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

double real(const schema::Value& value) {
  if (const auto* number = std::get_if<double>(&value)) return *number;
  if (const auto* number = std::get_if<std::int64_t>(&value)) return static_cast<double>(*number);
  return none;
}

std::int64_t integer(const schema::Value& value) {
  return std::get<std::int64_t>(value);
}

// Rows of smooth spheres with constant restitution, started and sampled like those of the paper.
constexpr const char* plain_gas =
    " d = 3 AND effects = '{}' AND sample_at IS NULL AND start IS NULL";

// The same gases with velocities shuffled.
constexpr const char* shuffled_gas =
    " d = 3 AND sample_at IS NULL AND start IS NULL AND (SELECT group_concat(key) FROM "
    "json_each(effects)) = "
    "'shuffle'";

// What tells means apart: the identity of a job but its seed and what it observes. Of the columns
// from the fourth on, those of gases that were prepared, changed or sampled in other ways.
constexpr const char* key_columns = "e, n, particles, sample_every, equilibrate, effects";
constexpr std::size_t keys = 6;

// What is averaged, in the order of read_means; of a Laguerre coefficient its order.
struct Measured {
  Observable means;
  int laguerre = 0;
};
constexpr std::array<Measured, 5> measured_columns{{{&MeanSeries::temperature},
                                                    {&MeanSeries::gamma_ratio},
                                                    {&MeanSeries::a2, 2},
                                                    {&MeanSeries::a3, 3},
                                                    {&MeanSeries::a4, 4}}};

schema::Row key_of(const schema::Row& row) {
  return {row.begin(), row.begin() + keys};
}

std::map<schema::Row, MeanSeries> read_means(const schema::Reader& store, const char* gas) {
  schema::Query rows = store.query(
      fmt::format("SELECT {}, realizations, tau, temperature, temperature_se, gamma_ratio,"
                  " gamma_ratio_se, a2, a2_se, a3, a3_se, a4, a4_se,"
                  " effects ->> '$.shuffle.every' FROM mean_series WHERE {}",
                  key_columns, gas));
  std::map<schema::Row, MeanSeries> all;
  while (const auto row = rows.next()) {
    const auto& r = *row;
    MeanSeries& series = all[key_of(r)];
    series.e = real(r[0]);
    series.n = real(r[1]);
    series.particles = integer(r[2]);
    series.sample_every = real(r[3]);
    series.equilibrate = real(r[4]);
    series.effects = std::get<std::string>(r[5]);
    series.realizations.push_back(integer(r[keys]));
    series.tau.push_back(real(r[keys + 1]));
    std::size_t column = keys + 2;
    for (const Measured& each : measured_columns) {
      Means& means = series.*each.means;
      means.value.push_back(real(r[column++]));
      const double standard_error = real(r[column++]);
      const std::int64_t runs = series.realizations.back();
      means.error.push_back(std::isfinite(means.value.back())
                                ? error_of_mean(each.laguerre, standard_error, runs,
                                                static_cast<double>(series.particles * runs))
                                : none);
    }
    if (const double every = real(r[column]); every > 0) series.shuffled_every = every;
  }
  return all;
}

// Adds the mean profiles of each series.
void read_profiles(const schema::Reader& store, std::map<schema::Row, MeanSeries>& all) {
  schema::Query rows = store.query(
      fmt::format("SELECT {}, name, tau, realizations, x, value, value_se FROM mean_profiles"
                  " WHERE {}",
                  key_columns, plain_gas));
  while (const auto row = rows.next()) {
    const auto& r = *row;
    const auto found = all.find(key_of(r));
    if (found == all.end()) continue;
    auto& profiles = found->second.profiles;
    const auto& name = std::get<std::string>(r[keys]);
    const double tau = real(r[keys + 1]);
    if (profiles.empty() || profiles.back().name != name || profiles.back().tau != tau) {
      profiles.push_back({.name = name, .tau = tau, .realizations = integer(r[keys + 2])});
    }
    profiles.back().x.push_back(real(r[keys + 3]));
    profiles.back().mean.value.push_back(real(r[keys + 4]));
    profiles.back().mean.error.push_back(bar(real(r[keys + 5]), profiles.back().realizations));
  }
}

// The velocity field nearest to the paper's, e = 0.80 at tau = 60, of the largest system.
std::optional<VelocityField> read_velocity_field(const schema::Reader& store) {
  schema::Query rows = store.query(
      fmt::format("SELECT e, n, particles, seed, job_id, fields.tau, coalesce(code_version, '')"
                  " FROM fields JOIN jobs USING (job_id)"
                  " WHERE name = 'velocity' AND status = 'done' AND n = 0.4 AND e < 1 AND {}"
                  " ORDER BY abs(e - 0.8), abs(fields.tau - 60), particles DESC, seed LIMIT 1",
                  plain_gas));
  const auto row = rows.next();
  if (!row) return std::nullopt;
  const auto& r = *row;
  const std::int64_t job_id = integer(r[4]);
  const auto field = store.field(job_id, "velocity", real(r[5]));
  const auto sample = store.last_sample(job_id, real(r[5]));
  if (!field || !sample || !sample->temperature) return std::nullopt;
  return VelocityField{.e = real(r[0]),
                       .n = real(r[1]),
                       .particles = integer(r[2]),
                       .seed = static_cast<std::uint64_t>(integer(r[3])),
                       .temperature = *sample->temperature,
                       .code_version = std::get<std::string>(r[6]),
                       .field = *field};
}

Realization read_realization(const schema::Reader& store, std::int64_t job_id, std::uint64_t seed) {
  Realization run{.job_id = job_id, .seed = seed};
  if (const auto results = store.results(job_id)) run.tau_c = results->tau_c;
  for (const schema::Sample& sample : store.samples(job_id)) {
    run.tau.push_back(sample.tau);
    run.temperature.push_back(sample.temperature.value_or(none));
    run.gamma_ratio.push_back(sample.gamma_ratio.value_or(none));
    run.a2.push_back(sample.a2.value_or(none));
    run.largest_cluster.push_back(sample.largest_cluster.value_or(none));
  }
  return run;
}

// A realization that was run again to observe more counts once, as in the views: its second run
// adds what the first did not observe, and the part beyond its end.
void add_what_is_new(Realization& run, Realization other) {
  if (other.tau.size() > run.tau.size()) std::swap(run, other);
  const auto fill = [](std::vector<double>& values, const std::vector<double>& from) {
    for (std::size_t k = 0; k < from.size(); ++k)
      if (std::isnan(values[k])) values[k] = from[k];
  };
  fill(run.temperature, other.temperature);
  fill(run.a2, other.a2);
  fill(run.largest_cluster, other.largest_cluster);
  if (!run.tau_c) run.tau_c = other.tau_c;
}

// Adds the runs that each mean averages, and counts those that are missing.
void read_runs(const schema::Reader& store, const char* gas,
               std::map<schema::Row, MeanSeries>& all) {
  schema::Query rows = store.query(
      fmt::format("SELECT {}, job_id, seed, status, coalesce(code_version, '') FROM jobs"
                  " WHERE kind = 'cooling' AND {} ORDER BY seed, status = 'done' DESC, job_id",
                  key_columns, gas));
  while (const auto row = rows.next()) {
    const auto& r = *row;
    const auto found = all.find(key_of(r));
    if (found == all.end()) continue;  // none of its realizations is done
    MeanSeries& series = found->second;
    const auto seed = static_cast<std::uint64_t>(integer(r[keys + 1]));
    const bool is_there = !series.runs.empty() && series.runs.back().seed == seed;
    if (std::get<std::string>(r[keys + 2]) != schema::name(schema::Status::done)) {
      series.missing += is_there ? 0 : 1;
      continue;
    }
    Realization run = read_realization(store, integer(r[keys]), seed);
    if (is_there)
      add_what_is_new(series.runs.back(), std::move(run));
    else
      series.runs.push_back(std::move(run));
    series.code_versions.insert(std::get<std::string>(r[keys + 3]));
  }
}

// A single sample, at the start, makes no series.
bool measured(const Means& means) {
  return std::ranges::count_if(means.value, [](double x) { return std::isfinite(x); }) > 1;
}

// The best series of each key among those that pass, by increasing key.
template <class T, class Pass, class Rank>
std::vector<T> best_of_each(const std::vector<T>& all, double T::*key, Pass pass, Rank rank) {
  std::map<double, const T*> best;
  for (const T& each : all) {
    if (each.e >= 1 || !pass(each)) continue;
    const T*& place = best[each.*key];
    if (place == nullptr || rank(*place) < rank(each)) place = &each;
  }
  std::vector<T> chosen;
  chosen.reserve(best.size());
  for (const auto& entry : best) chosen.push_back(*entry.second);
  return chosen;
}

// The noise of a mean falls with the particles of all its realizations together.
std::tuple<std::int64_t, double> rank(const MeanSeries& series) {
  return {series.particles * series.most_realizations(), series.tau.back()};
}

}  // namespace

double bar(double standard_error, std::int64_t realizations) {
  if (realizations < 2) return none;
  static thread_local std::map<std::int64_t, double> known;  // the quantile is dear
  const auto [place, is_new] = known.try_emplace(realizations, 0);
  if (is_new)
    place->second =
        analysis::student_t(static_cast<std::size_t>(realizations - 1), analysis::bar_confidence);
  return place->second * standard_error;
}

double error_of_mean(int laguerre, double standard_error, std::int64_t realizations,
                     double velocities, int d) {
  const double scatter = bar(standard_error, realizations);
  if (laguerre == 0) return scatter;
  const double known = analysis::laguerre_noise(laguerre, velocities, d);
  return scatter > known ? scatter : known;  // one realization has no scatter
}

std::int64_t MeanSeries::most_realizations() const {
  return *std::ranges::max_element(realizations);
}

const MeanProfile* MeanSeries::profile(const std::string& name, double at) const {
  const MeanProfile* best = nullptr;
  for (const MeanProfile& each : profiles) {
    if (each.name != name) continue;
    if (best == nullptr || std::abs(each.tau - at) < std::abs(best->tau - at)) best = &each;
  }
  return best;
}

Averages read_averages(const schema::Reader& store) {
  // The views do not check digests.
  store.must_match_digests({schema::Part::samples, schema::Part::profiles, schema::Part::results});
  auto all = read_means(store, plain_gas);
  read_profiles(store, all);
  read_runs(store, plain_gas, all);
  auto shuffled = read_means(store, shuffled_gas);
  read_runs(store, shuffled_gas, shuffled);
  Averages averages{.series = {}, .shuffled = {}, .velocity_field = read_velocity_field(store)};
  for (auto& entry : all) averages.series.push_back(std::move(entry.second));
  for (auto& entry : shuffled) averages.shuffled.push_back(std::move(entry.second));
  std::ranges::stable_sort(averages.series, {},
                           [](const MeanSeries& s) { return std::tuple(s.n, s.particles, s.e); });
  std::ranges::stable_sort(averages.shuffled, {}, [](const MeanSeries& s) {
    return std::tuple(s.e, s.n, s.particles, s.shuffled_every);
  });
  return averages;
}

std::optional<MeanTauC> mean_tau_c(const MeanSeries& series) {
  std::vector<double> reached;
  for (const Realization& run : series.runs) {
    if (run.tau_c) reached.push_back(*run.tau_c);
  }
  if (reached.empty()) return std::nullopt;
  const auto estimate = analysis::estimate(reached);
  return MeanTauC{.e = series.e,
                  .n = series.n,
                  .particles = series.particles,
                  .realizations = std::ssize(series.runs),
                  .reached = std::ssize(reached),
                  .tau_c = estimate.mean,
                  .error = bar(estimate.standard_error, std::ssize(reached)),
                  .half_interval =
                      reached.size() > 1 ? analysis::half_interval(estimate, reached.size()) : none,
                  .code_versions = series.code_versions};
}

std::vector<MeanSeries> choose_series(const Averages& averages, double n, Observable observable) {
  return best_of_each(
      averages.series, &MeanSeries::e,
      [&](const MeanSeries& s) { return s.n == n && measured(s.*observable); }, rank);
}

std::vector<MeanSeries> choose_densities(const Averages& averages, double e,
                                         Observable observable) {
  return best_of_each(
      averages.series, &MeanSeries::n,
      [&](const MeanSeries& s) { return s.e == e && measured(s.*observable); }, rank);
}

std::vector<MeanSeries> choose_profiles(const Averages& averages, double n,
                                        const std::string& name) {
  return best_of_each(
      averages.series, &MeanSeries::e,
      [&](const MeanSeries& s) { return s.n == n && s.profile(name, 0) != nullptr; }, rank);
}

const MeanSeries& nearest(const std::vector<MeanSeries>& series, double e) {
  return *std::ranges::min_element(series, {},
                                   [e](const MeanSeries& s) { return std::abs(s.e - e); });
}

std::vector<MeanTauC> choose_tau_c(const Averages& averages, double n) {
  std::vector<MeanTauC> all;
  for (const MeanSeries& series : averages.series) {
    if (series.n != n) continue;
    if (const auto tau_c = mean_tau_c(series)) all.push_back(*tau_c);
  }
  return best_of_each(
      all, &MeanTauC::e, [](const MeanTauC&) { return true; },
      [](const MeanTauC& t) { return t.particles * t.reached; });
}

}  // namespace haff::campaign
