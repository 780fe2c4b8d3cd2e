// SPDX-License-Identifier: GPL-3.0-or-later

// Profiles and fields of a gas, each only when it is asked for.
#include "campaign/job/views.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "campaign/job/gas.hpp"
#include "campaign/job/measurement.hpp"

using namespace haff;
using namespace haff::campaign;

namespace {

schema::Job job_with_views() {
  schema::Job wide = job(0.8, 4000);
  wide.observables = {"clusters", "correlations", "distribution",
                      "fields",   "structure",    "temperature"};
  wide.profiles_every = 10;
  wide.fields_at = {20};
  return wide;
}

std::vector<std::string> names(const Views& views) {
  std::vector<std::string> all;
  for (const auto& profile : views.profiles) all.push_back(profile.name);
  for (const auto& field : views.fields) all.push_back(field.name);
  return all;
}

}  // namespace

TEST_CASE("views: profiles and fields are taken at their times, and at no others") {
  const auto physics = job_with_views();
  const auto gas = campaign::gas(physics);
  schema::Sample sample{.tau = 10};
  using Names = std::vector<std::string>;
  CHECK(names(view(gas, physics, sample)) == Names{"rho", "G_parallel", "G_perpendicular", "S"});
  CHECK(sample.correlation_trace);
  CHECK(sample.largest_cluster);
  sample = {.tau = 20};
  CHECK(names(view(gas, physics, sample)) ==
        Names{"rho", "G_parallel", "G_perpendicular", "S", "density", "velocity", "temperature"});
  sample = {.tau = 15};
  CHECK(names(view(gas, physics, sample)).empty());
  CHECK_FALSE(sample.correlation_trace);
  CHECK_FALSE(sample.largest_cluster);
}

TEST_CASE("views: a profile that is not listed is not taken") {
  auto physics = job_with_views();
  physics.observables = {"clusters", "temperature"};
  schema::Sample sample{.tau = 10};
  CHECK(names(view(campaign::gas(physics), physics, sample)).empty());
  CHECK(sample.largest_cluster);
  CHECK_FALSE(sample.correlation_trace);
}

TEST_CASE("views: fields are in true units, however far the gas has cooled") {
  auto physics = job_with_views();
  physics.e = 0.5;
  physics.particles = 500;
  physics.fields_at = {60};
  physics.profiles_every = 60;
  auto gas = campaign::gas(physics);
  gas.run_to(engine::collisions_at(60, physics.particles));
  REQUIRE(gas.exponent() != 0);
  schema::Sample sample = measure(gas, physics, 60, {});
  const auto views = view(gas, physics, sample);
  const auto named = [&](const char* name) {
    return *std::find_if(views.fields.begin(), views.fields.end(),
                         [&](const auto& field) { return field.name == name; });
  };
  // The energy of the flow and of the motion within the cells is that of the gas:
  // d T = sum_r N_r (u^2 + d T_L (N_r - 1) / N_r) / N.
  const auto density = named("density"), u = named("velocity"), T = named("temperature");
  const double volume = std::pow(density.box / density.cells, 3);
  double twice_energy = 0;
  for (std::size_t c = 0; c < density.values.size(); ++c) {
    const double number = density.values[c] * volume;
    for (std::size_t a = 0; number > 0.5 && a < 3; ++a)
      twice_energy += number * std::pow(u.values[3 * c + a], 2);
    if (number > 1.5) twice_energy += 3 * T.values[c] * (number - 1);
  }
  CHECK(twice_energy / physics.particles ==
        doctest::Approx(3 * *sample.temperature).epsilon(1e-12));
}

TEST_CASE("views: every observable of the whole gas is taken, in the order of the table") {
  auto physics = job(0.8, 4000);
  physics.observables = {"cluster_sizes", "energy_spectrum", "pair_distribution", "tail"};
  physics.profiles_every = 10;
  schema::Sample sample{.tau = 10};
  const auto taken = names(view(campaign::gas(physics), physics, sample));
  using Names = std::vector<std::string>;
  const Names fixed{"g",         "E_perpendicular", "E_parallel",
                    "enstrophy", "cluster_sizes",   "mean_cluster"};
  // Some two of 4000 speeds are beyond c = 3: too few for an exponent.
  REQUIRE(taken.size() == fixed.size() + 1);
  CHECK(taken.front() == "tail");
  CHECK(Names(taken.begin() + 1, taken.end()) == fixed);
}

TEST_CASE(
    "views: a mixture has profiles for each pair of species, and temperatures weighted by mass") {
  auto physics = job(1, 2000);
  physics.n = 0.2;
  physics.effects = R"({"mixture":{"diameter_ratio":0.5,"fraction":0.5,"mass_ratio":0.1}})";
  physics.observables = {"clusters",      "correlations", "distribution", "energy_spectrum",
                         "cluster_sizes", "fields",       "structure",    "pair_distribution"};
  physics.profiles_every = 10;
  physics.fields_at = {10};
  auto gas = campaign::gas(physics);
  gas.run_to(engine::collisions_at(10, physics.particles));
  schema::Sample sample = measure(gas, physics, 10, {});
  const auto views = view(gas, physics, sample);
  const auto profile = [&](const char* name) {
    return *std::ranges::find(views.profiles, name, &schema::Profile::name);
  };
  CHECK(profile("g_11").x.front() == 1);
  CHECK(profile("g_12").x.front() == 0.75);
  CHECK(profile("g_22").x.front() == 0.5);
  // Every pair is one of two species, so partial structure factors add up to the whole.
  const auto S = profile("S"), one = profile("S_11"), cross = profile("S_12"),
             two = profile("S_22");
  for (std::size_t i = 0; i < S.value.size(); ++i)
    CHECK(one.value[i] + 2 * cross.value[i] + two.value[i] ==
          doctest::Approx(S.value[i]).epsilon(1e-12));
  // In equilibrium rho(0) = 1 if speeds are weighted by mass, and 3 or more if they are not. The
  // first bins up to c = 0.5 hold 5 % of 2000 particles: within 5 standard errors.
  const auto rho = profile("rho");
  CHECK(rho.value[4] == doctest::Approx(std::exp(-0.45 * 0.45)).epsilon(0.5));
  CHECK(sample.correlation_trace);
  CHECK(sample.largest_cluster);
  CHECK(views.fields.size() == 3);
}
