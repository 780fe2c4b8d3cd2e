// SPDX-License-Identifier: GPL-3.0-or-later

// The table of agreement for stores that are made from theory and must agree with it.
#include "campaign/paper/claims/agreement.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "analysis/theory/cooling.hpp"
#include "analysis/theory/energy_equation.hpp"
#include "analysis/theory/enskog_boltzmann.hpp"
#include "support/synthetic_store.hpp"
#include "support/temporary_folder.hpp"

using namespace haff;
using namespace haff::campaign;

namespace {

std::vector<Comparison> of_theory() {
  auto store = schema::Store::in_memory();
  add_finished(store, 0.80, 0.4, 100'000, 3, 180);
  add_finished(store, 0.85, 0.4, 100'000, 3, 100);
  add_finished(store, 0.90, 0.4, 100'000, 3, 160);
  add_finished(store, 0.85, 0.2, 100'000, 3, 100);
  return agreement(read_averages(store));
}

std::vector<Comparison> rows_of(const std::string& claim, const std::vector<Comparison>& table) {
  std::vector<Comparison> found;
  std::ranges::copy_if(table, std::back_inserter(found),
                       [&](const Comparison& row) { return row.claim == claim; });
  return found;
}

std::string contents(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("agreement: a gas that obeys theory is not said to differ from it") {
  const auto table = of_theory();
  for (const char* claim : {"energy", "decay", "cutoff", "order"}) {
    CAPTURE(claim);
    const auto rows = rows_of(claim, table);
    CHECK_FALSE(rows.empty());
    for (const auto& row : rows) CHECK(row.holds != false);
  }
  CHECK(rows_of("tau_c", table).size() == 3);  // where the paper has one
  CHECK(rows_of("decay", table).size() == 4);
  for (const auto& row : rows_of("cutoff", table))
    CHECK(row.value == doctest::Approx(0.30).epsilon(0.05));
}

namespace {

// A gas that obeys a theory exactly: three equal realizations, so large that random errors vanish.
// The verdicts are those on the theory.
struct Theory {
  double b = analysis::cutoff_b;
  analysis::Velocities velocities = analysis::Velocities::enskog_boltzmann;
  double source = 1;    // the source of a_2, in units of the true one
  bool returns = true;  // whether a_2 returns to zero before tau_c
  double a3_over_a2 = 0.3;
};

constexpr double no_correlations = 1e-3;  // b

Averages averages_of(const Theory& theory, double e) {
  constexpr double n = 0.4;
  MeanSeries series{.e = e, .n = n, .particles = 1'000'000'000'000, .sample_every = 1};
  const double end = std::ceil(1.1 * analysis::energy_equation_tau_c({.e = e, .n = n}));
  for (double tau = 0; tau <= end; ++tau) series.tau.push_back(tau);
  const auto energy =
      analysis::energy_equation({.e = e, .n = n}, series.tau, theory.b, theory.velocities);
  Realization run;
  run.tau = series.tau;
  for (std::size_t k = 0; k < series.tau.size(); ++k) {
    const double tau = series.tau[k];
    run.temperature.push_back(energy[k].energy * analysis::initial_temperature());
    run.gamma_ratio.push_back(energy[k].gamma_ratio);
    run.a2.push_back(theory.source * analysis::boltzmann_a2(tau, e) *
                     (theory.returns && tau > 40 ? std::exp(-(tau - 40) / 20) : 1));
    run.largest_cluster.push_back(NAN);
    series.a3.value.push_back(theory.a3_over_a2 * run.a2.back());
    series.a4.value.push_back(0.1 * run.a2.back());
    series.realizations.push_back(3);
  }
  run.tau_c = analysis::tau_c(run.tau, run.temperature, e);
  series.temperature.value = run.temperature;
  series.gamma_ratio.value = run.gamma_ratio;
  series.a2.value = run.a2;
  series.runs = {run, run, run};
  Averages averages;
  averages.series = {series};
  return averages;
}

std::optional<bool> verdict(const std::string& claim, const Theory& theory, double e = 0.8) {
  const auto rows = rows_of(claim, agreement(averages_of(theory, e)));
  return rows.empty() ? std::optional(false) : rows.front().holds;  // no rows without tau_c
}

}  // namespace

TEST_CASE("agreement: each claim on cooling holds for its theory and fails for similar theories") {
  constexpr double b = analysis::cutoff_b;
  using analysis::Velocities;
  for (const char* claim : {"tau_c", "energy", "decay", "cutoff"}) {
    CAPTURE(claim);
    CHECK(verdict(claim, {}) == true);
    CHECK(verdict(claim, {.b = no_correlations, .velocities = Velocities::gaussian}) == false);
    CHECK(verdict(claim, {.b = no_correlations}) == false);  // Enskog-Boltzmann alone
    CHECK(verdict(claim, {.b = 0.8 * b}) == false);
    CHECK(verdict(claim, {.b = 1.2 * b}) == false);
  }
}

TEST_CASE(
    "agreement: each claim on velocities holds for its theory and fails for similar theories") {
  constexpr double e = 0.9;
  for (const char* claim : {"a2 early", "a2 return", "order"}) {
    CAPTURE(claim);
    CHECK(verdict(claim, {}, e) == true);
  }
  CHECK(verdict("a2 early", {.source = 0}, e) == false);  // Haff's law: Gaussian velocities
  CHECK(verdict("a2 early", {.source = 1.2}, e) == false);
  CHECK(verdict("a2 early", {.source = 0.8}, e) == false);
  CHECK(verdict("a2 return", {.returns = false}, e) == false);  // Enskog-Boltzmann alone
  CHECK(verdict("order", {.a3_over_a2 = 1.2}, e) == false);
}

TEST_CASE("agreement: a gas without correlations, or whose correlations do not scale, fails") {
  auto store = schema::Store::in_memory();
  add_finished_with_profiles(store, 0.8, 0.4, 200'000, 2, 60, 10, {});
  const Averages averages = read_averages(store);
  const auto holds = [&](const std::string& claim, const Averages& of) {
    const auto rows = rows_of(claim, agreement(of));
    REQUIRE_FALSE(rows.empty());
    return rows.front().holds;
  };
  CHECK(holds("correlations", averages) == true);

  Averages still = averages;  // at all times as at tau = 60
  for (MeanProfile& profile : still.series.front().profiles)
    if (profile.name == "G_parallel")
      profile.mean = averages.series.front().profile("G_parallel", 60)->mean;
  CHECK(holds("collapse", still) == false);
  CHECK(holds("collapse trend", still) == false);

  Averages none = averages;
  for (MeanProfile& profile : none.series.front().profiles)
    for (double& value : profile.mean.value) value = 0;
  CHECK(holds("correlations", none) == false);
}

TEST_CASE("agreement: no data, no claims") {
  CHECK(agreement(read_averages(schema::Store::in_memory())).empty());
}

TEST_CASE("agreement: a table has a row per claim, and empty fields where data are missing") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "agreement.csv";
  write_agreement({{.claim = "order", .quantity = "a, b", .value = 0.1, .holds = false}}, file);
  CHECK(contents(file) ==
        "claim,quantity,e,n,value,half_interval_95,reference,source,criterion,holds,note\n"
        "order,\"a, b\",,,0.10000000000000001,,,\"\",\"\",no,\"\"\n");
}
