// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/planning/forecast.hpp"

#include <doctest/doctest.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "campaign/planning/calibration.hpp"

using namespace haff;
using campaign::Forecast;
using campaign::Prices;

namespace {

constexpr double tau_max = 20;

schema::Job small_gas(std::optional<double> e = 0.9) {
  return {.e = e, .n = 0.4, .particles = 500, .seed = 1, .observables = {"temperature"}};
}

schema::Job with_effects(std::string effects) {
  schema::Job job = small_gas();
  job.effects = std::move(effects);
  return job;
}

// A job that is done, and took this long per collision.
schema::JobRow known(const schema::Job& job, double seconds_per_collision) {
  schema::JobRow row;
  row.job = job;
  row.progress.collisions = 1'000'000;
  row.progress.cpu_seconds = 1e6 * seconds_per_collision;
  return row;
}

// The speed known from the store alone; nothing where a trial would be needed.
std::optional<double> seconds_per_collision(const std::vector<schema::JobRow>& rows,
                                            const schema::Job& job) {
  Forecast forecast(rows);
  const double seconds = forecast.cpu_seconds({.job = job, .tau_max = tau_max});
  if (forecast.source() != "speeds as in this store") return std::nullopt;
  return seconds / (0.5 * tau_max * job.particles);
}

}  // namespace

TEST_CASE("forecast: jobs that differ in effects have speeds of their own") {
  const auto plain = small_gas(), shuffled = with_effects(R"({"shuffle":{"every":1.0}})");
  const std::vector rows{known(plain, 1), known(shuffled, 2)};
  CHECK(*seconds_per_collision(rows, plain) == doctest::Approx(1));
  CHECK(*seconds_per_collision(rows, shuffled) == doctest::Approx(2));
  CHECK_FALSE(seconds_per_collision(rows, with_effects(R"({"thermostat":{"rate":0.1}})")));
}

TEST_CASE("forecast: jobs that differ in observables or in intervals have speeds of their own") {
  const schema::Job seldom = small_gas();
  schema::Job often = seldom, profiles = seldom;
  often.sample_every = 0.05;
  profiles.observables = {"distribution", "temperature"};
  profiles.profiles_every = 1;
  const std::vector rows{known(seldom, 1), known(often, 2)};
  CHECK(*seconds_per_collision(rows, seldom) == doctest::Approx(1));
  CHECK(*seconds_per_collision(rows, often) == doctest::Approx(2));
  CHECK_FALSE(seconds_per_collision(rows, profiles));
}

TEST_CASE("forecast: realizations share a speed, whatever their start") {
  schema::Job other = small_gas();
  other.seed = 2;
  other.equilibrate = 100;
  const std::vector rows{known(small_gas(), 1), known(other, 3)};
  CHECK(*seconds_per_collision(rows, other) == doctest::Approx(2));
}

TEST_CASE("forecast: jobs of the same e count, and those of another e where there are none") {
  const std::vector rows{known(small_gas(0.9), 1), known(small_gas(0.8), 3)};
  CHECK(*seconds_per_collision(rows, small_gas(0.8)) == doctest::Approx(3));
  CHECK(*seconds_per_collision(rows, small_gas(0.7)) == doctest::Approx(2));
}

TEST_CASE("forecast: equilibrations have one speed, whatever effects the cooling has") {
  const auto plain = schema::equilibration_of(small_gas());
  const auto shuffled = schema::equilibration_of(with_effects(R"({"shuffle":{"every":1.0}})"));
  CHECK(*seconds_per_collision({known(plain, 1)}, shuffled) == doctest::Approx(1));
  CHECK_FALSE(seconds_per_collision({known(plain, 1)}, small_gas()));
}

TEST_CASE("forecast: a gas that the store has hardly run is tried out") {
  CHECK_FALSE(seconds_per_collision({known(small_gas(), 1e-8)}, small_gas()));
  schema::JobRow begun = known(small_gas(), 1);  // a large gas takes a long time to start
  begun.progress.collisions = 0;
  CHECK_FALSE(seconds_per_collision({begun}, small_gas()));
}

TEST_CASE("calibration: a trial includes all costs of a job and no others") {
  schema::Job job = small_gas();
  const Prices plain = campaign::try_out(job, tau_max, 0.01);
  for (const double price :
       {plain.start, plain.collision, plain.synchronization, plain.sample, plain.commit})
    CHECK(price > 0);
  CHECK(plain.profiles == 0);
  CHECK(plain.fields == 0);
  job.observables = {"clusters", "distribution", "fields", "temperature"};
  job.profiles_every = 5;
  job.fields_at = {10};
  const Prices with_views = campaign::try_out(job, tau_max, 0.01);
  CHECK(with_views.profiles > 0);
  CHECK(with_views.fields > 0);
}

TEST_CASE("calibration: a trial outlives inelastic collapse") {
  CHECK(campaign::try_out(small_gas(0.05), 1000, 1).collision > 0);
}

TEST_CASE("forecast: more samples cost more") {
  schema::Job often = small_gas();
  often.sample_every = 0.01;
  Forecast forecast({});
  CHECK(forecast.cpu_seconds({.job = often, .tau_max = tau_max}) >
        forecast.cpu_seconds({.job = small_gas(), .tau_max = tau_max}));
}
