// SPDX-License-Identifier: GPL-3.0-or-later

// The views that average over realizations, compared with a direct computation.
#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>

#include "schema/fixture.hpp"

using namespace haff::schema;

namespace {

struct Realization {
  Job job;
  std::vector<Sample> samples;
  std::optional<double> tau_c = {};
};

// Irregular numbers, the same every time.
double noise(std::uint64_t seed, std::uint64_t k) {
  std::uint64_t x = (seed * 1000 + k + 1) * 0x9e3779b97f4a7c15;
  x ^= x >> 31;
  x *= 0xbf58476d1ce4e5b9;
  x ^= x >> 29;
  return static_cast<double>(x >> 11) * 0x1p-53 - 0.5;
}

// A series of a gas whose temperature is near `scale`. Its numbers at a given tau do not depend on
// how often it is sampled.
Realization series(const Job& job, int length, double scale = 1) {
  Realization made{.job = job, .samples = {}};
  for (int k = 0; k <= length; ++k) {
    const double tau = k * job.sample_every;
    const auto draw = [&](std::uint64_t which) {
      return noise(job.seed, 10 * static_cast<std::uint64_t>(std::lround(tau)) + which);
    };
    Sample sample{.tau = tau,
                  .time = 1 + tau + 0.1 * draw(0),
                  .temperature = scale * (1 + 1e-3 * draw(1)),
                  .a2 = 0.01 * draw(2),
                  .a3 = 0.01 * draw(3),
                  .a4 = 0.01 * draw(4),
                  .a5 = 0.01 * draw(5),
                  .a6 = 0.01 * draw(6)};
    if (k > 0) {
      sample.gamma_ratio = 1 + 0.01 * draw(7);
      sample.collision_rate = 4 + 0.1 * draw(8);
      sample.pressure = 1 + 0.1 * draw(9);
    }
    made.samples.push_back(sample);
  }
  return made;
}

// A store in which these jobs were planned and finished in the given order.
Store store_of(const std::vector<Realization>& realizations) {
  Store store = Store::in_memory();
  for (const Realization& one : realizations) store.add(plan({one.job}));
  equilibrate(store);
  std::vector<Claim> claims;
  while (const auto claim = store.claim(me, "test")) claims.push_back(*claim);
  for (const Realization& one : realizations)
    for (const Claim& claim : claims)
      if (identity(claim.job) == identity(one.job))
        complete(store, claim, one.samples, Results{.tau_c = one.tau_c});
  return store;
}

std::vector<Row> rows(const Store& store, const std::string& sql) {
  Query query = store.query(sql);
  std::vector<Row> all;
  while (auto row = query.next()) all.push_back(*row);
  return all;
}

double mean(const std::vector<double>& x) {
  long double sum = 0;
  for (const double value : x) sum += value;
  return static_cast<double>(sum / static_cast<long double>(x.size()));
}

double standard_error(const std::vector<double>& x) {
  long double sum = 0;
  const long double centre = mean(x);
  for (const double value : x) sum += (value - centre) * (value - centre);
  const auto R = static_cast<long double>(x.size());
  return static_cast<double>(std::sqrt(sum / (R - 1) / R));
}

// The rounding error of a sum of a few doubles.
constexpr double rounding = 1e-14;

}  // namespace

TEST_CASE("means and standard errors agree with a direct computation, also at T = 1e-60") {
  for (const double scale : {1.0, 1e-60}) {
    CAPTURE(scale);
    std::vector<Realization> realizations;
    for (std::uint64_t seed = 1; seed <= 5; ++seed)
      realizations.push_back(series(cooling(0.8, seed), 3, scale));
    const auto table = rows(store_of(realizations),
                            "SELECT tau, realizations, time, time_se, temperature, "
                            "temperature_se, gamma_ratio, gamma_ratio_se, collision_rate, "
                            "collision_rate_se, pressure, pressure_se, a2, a2_se, a3, a3_se, a4, "
                            "a4_se, a5, a5_se, a6, a6_se FROM mean_series");
    REQUIRE(table.size() == 4);
    for (std::size_t k = 0; k < 4; ++k) {
      CHECK(table[k][0] == Value{static_cast<double>(k)});
      CHECK(table[k][1] == Value{std::int64_t{5}});
      std::vector<std::vector<double>> columns(10);
      for (const Realization& one : realizations) {
        const Sample& sample = one.samples[k];
        columns[0].push_back(sample.time);
        std::size_t column = 1;
        for (const auto& value :
             {sample.temperature, sample.gamma_ratio, sample.collision_rate, sample.pressure,
              sample.a2, sample.a3, sample.a4, sample.a5, sample.a6}) {
          if (value) columns[column].push_back(*value);
          ++column;
        }
      }
      for (std::size_t column = 0; column < columns.size(); ++column) {
        const Value& average = table[k][2 + 2 * column];
        const Value& error = table[k][3 + 2 * column];
        if (columns[column].empty()) {
          CHECK(average == Value{Null{}});
          CHECK(error == Value{Null{}});
          continue;
        }
        CHECK(std::get<double>(average) ==
              doctest::Approx(mean(columns[column])).scale(0).epsilon(rounding));
        // The deviations are a thousandth of the mean, and have three digits fewer.
        CHECK(std::get<double>(error) ==
              doctest::Approx(standard_error(columns[column])).scale(0).epsilon(1e4 * rounding));
      }
    }
  }
}

TEST_CASE("equal realizations have the standard error zero") {
  Realization one = series(cooling(0.8, 1), 1), other = one;
  other.job.seed = 2;
  const auto table =
      rows(store_of({one, other}), "SELECT temperature_se, a2_se FROM mean_series WHERE tau = 1");
  CHECK(table == std::vector<Row>{{0.0, 0.0}});
}

TEST_CASE("one realization has a mean and no standard error") {
  const Realization one = series(cooling(), 1);
  const auto table = rows(store_of({one}),
                          "SELECT realizations, temperature, temperature_se, a2, a2_se "
                          "FROM mean_series WHERE tau = 1");
  CHECK(table == std::vector<Row>{{std::int64_t{1}, *one.samples[1].temperature, Null{},
                                   *one.samples[1].a2, Null{}}});
}

TEST_CASE("averages do not depend on the order of jobs, to the last bit") {
  std::vector<Realization> realizations;
  for (const double e : {0.8, 0.9})
    for (std::uint64_t seed = 1; seed <= 7; ++seed) {
      realizations.push_back(series(cooling(e, seed), 5));
      realizations.back().tau_c = 58 + noise(seed, 99);
    }
  const auto forward = store_of(realizations);
  const auto series_before = rows(forward, "SELECT * FROM mean_series");
  const auto tau_c_before = rows(forward, "SELECT * FROM mean_tau_c");
  CHECK(series_before.size() == 12);
  for (int shuffle = 0; shuffle < 5; ++shuffle) {
    std::rotate(realizations.begin(), realizations.begin() + 3, realizations.end());
    std::reverse(realizations.begin(), realizations.begin() + 6);
    const Store store = store_of(realizations);
    CHECK(rows(store, "SELECT * FROM mean_series") == series_before);
    CHECK(rows(store, "SELECT * FROM mean_tau_c") == tau_c_before);
  }
}

TEST_CASE("a change in any part of the physics but the seed makes another series") {
  std::vector<Job> jobs(9, cooling());
  jobs[1].e = 0.9;
  jobs[2].n = 0.5;
  jobs[3].particles = 2000;
  jobs[4].equilibrate = 60;
  jobs[5].sample_every = 2;
  jobs[6].effects = R"({"shuffle":{"every":1}})";
  jobs[7].sample_at.tau.listed = {0.5};
  jobs[8].start = {.kind = Start::Kind::shear_wave, .amplitude = 0.5, .waves = 1};
  std::vector<Realization> realizations;
  realizations.reserve(jobs.size());
  for (const Job& job : jobs) realizations.push_back(series(job, 1));
  const Store store = store_of(realizations);
  for (const char* view : {"mean_series WHERE tau = 0", "mean_tau_c"}) {
    const std::string from = std::string(" FROM ") + view;
    CHECK(rows(store, "SELECT count(*), max(realizations)" + from) ==
          std::vector<Row>{{std::int64_t{9}, std::int64_t{1}}});
    CHECK(rows(store,
               "SELECT count(DISTINCT d || e || n || particles || equilibrate || "
               "sample_every || coalesce(sample_at, '') || coalesce(start, '') || effects)" +
                   from) == std::vector<Row>{{std::int64_t{9}}});
  }
}

TEST_CASE(
    "a realization that was run again with more observables is averaged once, with all of them") {
  Realization first = series(cooling(0.8, 1), 2), second = series(cooling(0.8, 1), 1);
  second.job.observables = {"laguerre", "structure", "temperature"};
  for (Sample& sample : first.samples) sample.a2 = std::nullopt;
  const double a2 = *second.samples[1].a2;
  first.tau_c = second.tau_c = 58;
  const Store store = store_of({first, second, series(cooling(0.8, 2), 2)});
  CHECK(rows(store, "SELECT tau, realizations FROM mean_series") ==
        std::vector<Row>{{0.0, std::int64_t{2}}, {1.0, std::int64_t{2}}, {2.0, std::int64_t{2}}});
  const double other = *series(cooling(0.8, 2), 2).samples[1].a2;
  CHECK(rows(store, "SELECT a2 FROM mean_series WHERE tau = 1") ==
        std::vector<Row>{{(a2 + other) / 2}});
  CHECK(rows(store, "SELECT realizations, reached, tau_c FROM mean_tau_c") ==
        std::vector<Row>{{std::int64_t{2}, std::int64_t{1}, 58.0}});
}

TEST_CASE("a mean for one e uses an index and reads no other gas") {
  const Store store = store_of({series(cooling(0.8, 1), 1), series(cooling(0.9, 1), 1)});
  std::string plan;
  for (const Row& row : rows(store, "EXPLAIN QUERY PLAN SELECT * FROM mean_series WHERE e = 0.9"))
    plan += std::get<std::string>(row.back()) + "\n";
  CAPTURE(plan);
  CHECK(plan.find("SEARCH jobs USING INDEX jobs_averaged (e=?)") != std::string::npos);
  CHECK(plan.find("SEARCH samples USING PRIMARY KEY (job_id=?)") != std::string::npos);
}

TEST_CASE("only cooling jobs that are done are averaged") {
  Store store = store_of({series(cooling(0.8, 1), 1)});
  store.add(plan({cooling(0.8, 2)}));
  equilibrate(store);
  const Claim claim = *store.claim(me, "test");
  store.commit(claim.lease, {.samples = series(cooling(0.8, 2), 1).samples});
  const std::string number = "SELECT max(realizations) FROM mean_series";
  CHECK(rows(store, number) == std::vector<Row>{{std::int64_t{1}}});
  complete(store, claim, {}, Results{});
  CHECK(rows(store, number) == std::vector<Row>{{std::int64_t{2}}});
  CHECK(rows(store, "SELECT DISTINCT e FROM mean_series") == std::vector<Row>{{0.8}});
}

TEST_CASE("a series that ends early leaves the others averaged") {
  const Realization short_one = series(cooling(0.8, 1), 1), long_one = series(cooling(0.8, 2), 3);
  CHECK(rows(store_of({short_one, long_one}), "SELECT tau, realizations FROM mean_series") ==
        std::vector<Row>{{0.0, std::int64_t{2}},
                         {1.0, std::int64_t{2}},
                         {2.0, std::int64_t{1}},
                         {3.0, std::int64_t{1}}});
}

TEST_CASE("tau_c is averaged over the realizations that reached it") {
  std::vector<Realization> realizations;
  for (std::uint64_t seed = 1; seed <= 4; ++seed)
    realizations.push_back({.job = cooling(0.8, seed), .samples = {}});
  realizations[0].tau_c = 57;
  realizations[1].tau_c = 60;
  realizations[3].tau_c = 57;
  const auto table = rows(store_of(realizations),
                          "SELECT e, realizations, reached, tau_c, tau_c_se FROM mean_tau_c");
  CHECK(table == std::vector<Row>{{0.8, std::int64_t{4}, std::int64_t{3}, 58.0, 1.0}});

  realizations[0].tau_c = realizations[1].tau_c = realizations[3].tau_c = std::nullopt;
  CHECK(rows(store_of(realizations), "SELECT reached, tau_c, tau_c_se FROM mean_tau_c") ==
        std::vector<Row>{{std::int64_t{0}, Null{}, Null{}}});
}

TEST_CASE("60 jobs of 1000 samples are averaged within seconds") {
  std::vector<Realization> realizations;
  for (const double e : {0.75, 0.8, 0.85, 0.9, 0.95})
    for (std::uint64_t seed = 1; seed <= 12; ++seed)
      realizations.push_back(series(cooling(e, seed), 1000));
  const Store store = store_of(realizations);
  const auto begin = std::chrono::steady_clock::now();
  CHECK(rows(store, "SELECT * FROM mean_series").size() == 5005);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  MESSAGE("mean_series of 60 000 samples: " << seconds.count() << " s");
  CHECK(seconds.count() < 10);  // 1.0 s when nothing else runs
}

TEST_CASE("a gas without e is stored with NULL for e, and averaged") {
  Store store = Store::in_memory();
  std::vector<Job> jobs{cooling(0.8, 1), cooling(0.8, 2)};
  for (Job& job : jobs) {
    job.e = std::nullopt;
    job.effects = R"({"restitution":{"A":0.1,"law":"viscoelastic"}})";
  }
  store.add(plan(jobs));
  equilibrate(store);
  for (const double temperature : {0.5, 0.7}) {
    const auto claim = store.claim(me, "test");
    CHECK_FALSE(claim->job.e);
    complete(store, *claim, {{.tau = 0, .temperature = temperature}}, Results{});
  }
  auto rows = store.query(
      "SELECT mean_series.e, temperature, gamma_ratio, tau_c FROM mean_series JOIN mean_tau_c "
      "USING (effects)");
  const auto row = rows.next().value();
  CHECK(std::holds_alternative<std::monostate>(row[0]));
  CHECK(std::get<double>(row[1]) == doctest::Approx(0.6));
  CHECK(std::holds_alternative<std::monostate>(row[2]));
  CHECK(std::holds_alternative<std::monostate>(row[3]));
  auto found = store.query(
      "SELECT count(*) FROM job_effects WHERE effect = 'restitution' AND value = 'viscoelastic'");
  CHECK(std::get<std::int64_t>(found.next().value()[0]) == 2);
}
