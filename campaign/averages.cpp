#include "campaign/averages.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <variant>

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

// Rows of smooth spheres with constant restitution.
constexpr const char* plain_gas = " WHERE d = 3 AND effects = '{}'";

std::vector<MeanSeries> read_series(const schema::Reader& store) {
  // Columns 4 to 7 set series of the same gas apart that were prepared or sampled in other ways.
  schema::Query rows = store.query(
      std::string("SELECT e, n, particles, sample_every, equilibrate, precision, observables,"
                  " realizations, tau, temperature, temperature_se, gamma_ratio, gamma_ratio_se,"
                  " a2, a2_se, a3, a3_se, a4, a4_se FROM mean_series") +
      plain_gas);
  constexpr std::size_t key_columns = 7;
  std::vector<MeanSeries> all;
  schema::Row last;
  while (const auto row = rows.next()) {
    const auto& r = *row;
    if (last.empty() || !std::equal(r.begin(), r.begin() + key_columns, last.begin())) {
      all.emplace_back();
      all.back().e = real(r[0]);
      all.back().n = real(r[1]);
      all.back().particles = integer(r[2]);
      all.back().sample_every = real(r[3]);
      last = r;
    }
    MeanSeries& series = all.back();
    series.realizations.push_back(integer(r[7]));
    series.tau.push_back(real(r[8]));
    std::size_t column = 9;
    for (const Observable each : {&MeanSeries::temperature, &MeanSeries::gamma_ratio,
                                  &MeanSeries::a2, &MeanSeries::a3, &MeanSeries::a4}) {
      (series.*each).value.push_back(real(r[column++]));
      (series.*each).error.push_back(real(r[column++]));
    }
  }
  return all;
}

std::vector<MeanTauC> read_tau_c(const schema::Reader& store) {
  schema::Query rows =
      store.query(std::string("SELECT e, n, particles, realizations, reached, tau_c, tau_c_se"
                              " FROM mean_tau_c") +
                  plain_gas);
  std::vector<MeanTauC> all;
  while (const auto row = rows.next()) {
    const auto& r = *row;
    all.push_back({.e = real(r[0]),
                   .n = real(r[1]),
                   .particles = integer(r[2]),
                   .realizations = integer(r[3]),
                   .reached = integer(r[4]),
                   .tau_c = real(r[5]),
                   .error = real(r[6])});
  }
  return all;
}

// One sample, at the start, is no series.
bool measured(const Means& means) {
  return std::ranges::count_if(means.value, [](double x) { return std::isfinite(x); }) > 1;
}

// Of all that pass, the best of each e, by increasing e.
template <class T, class Pass, class Rank>
std::vector<T> best_of_each_e(const std::vector<T>& all, Pass pass, Rank rank) {
  std::map<double, const T*> best;
  for (const T& each : all) {
    if (each.e >= 1 || !pass(each)) continue;
    const T*& place = best[each.e];
    if (place == nullptr || rank(*place) < rank(each)) place = &each;
  }
  std::vector<T> chosen;
  chosen.reserve(best.size());
  for (const auto& entry : best) chosen.push_back(*entry.second);
  return chosen;
}

}  // namespace

std::int64_t MeanSeries::most_realizations() const {
  return *std::ranges::max_element(realizations);
}

Averages read_averages(const schema::Reader& store) {
  return {.series = read_series(store), .tau_c = read_tau_c(store)};
}

std::vector<MeanSeries> choose_series(const Averages& averages, double n, Observable observable) {
  return best_of_each_e(
      averages.series, [&](const MeanSeries& s) { return s.n == n && measured(s.*observable); },
      [](const MeanSeries& s) {
        return std::tuple(s.particles, s.most_realizations(), s.tau.back());
      });
}

const MeanSeries& nearest(const std::vector<MeanSeries>& series, double e) {
  return *std::ranges::min_element(series, {},
                                   [e](const MeanSeries& s) { return std::abs(s.e - e); });
}

std::vector<MeanTauC> choose_tau_c(const Averages& averages, double n) {
  return best_of_each_e(
      averages.tau_c, [&](const MeanTauC& t) { return t.n == n && t.reached > 0; },
      [](const MeanTauC& t) { return std::tuple(t.particles, t.reached); });
}

}  // namespace haff::campaign
