// What errors come from and what less of them would cost, of gases whose errors are put in.
#include "campaign/cost.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "campaign/assessment.hpp"
#include "support/synthetic_store.hpp"
#include "support/temporary_folder.hpp"

using namespace haff;
using namespace haff::campaign;
using doctest::Approx;

namespace {

constexpr Quantity a2{.measure = Measure::a2, .from = 5, .to = 15};

// Realizations whose a2 is constant in tau: `mean` and normal noise.
PilotSeries gas(std::uint32_t particles, std::size_t realizations, double mean, double deviation,
                double cpu_seconds) {
  PilotSeries series{
      .job = {.e = 0.9, .n = 0.4, .particles = particles, .observables = {"laguerre"}},
      .pilots = {}};
  Gaussian gaussian(particles);
  for (std::size_t k = 0; k < realizations; ++k) {
    Pilot pilot{.seed = k + 1, .tau_max = 15, .cpu_seconds = cpu_seconds};
    const double value = mean + deviation * gaussian();
    for (int tau = 0; tau <= 15; ++tau)
      pilot.samples.push_back({.tau = static_cast<double>(tau), .a2 = value});
    series.pilots.push_back(pilot);
  }
  return series;
}

// a2 = -0.04 but for 0.01 more in the small box; noise as N^-1/2.
std::vector<PilotSeries> two_sizes() {
  return {gas(1000, 256, -0.03, 0.02, 0.1), gas(4000, 256, -0.04, 0.01, 0.5)};
}

const Statistics& of_size(const Assessment& assessment, std::uint32_t particles) {
  return *std::ranges::find_if(assessment.statistics, [&](const Statistics& each) {
    return each.quantity == a2 && each.job.particles == particles;
  });
}

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("cost: errors of independent realizations fall as one over the root") {
  const Assessment assessment = assess(two_sizes());
  const Statistics& small = of_size(assessment, 1000);
  CHECK(small.realizations == 256);
  CHECK(small.error == Approx(0.02 / 16).epsilon(0.2));  // four errors of an error: 18 %
  CHECK(small.cpu_seconds == Approx(0.1));
  REQUIRE(small.slope);
  CHECK(std::abs(small.slope->value + 0.5) < 4 * small.slope->error);
  CHECK(small.half_interval == Approx(1.97 * small.error).epsilon(0.01));
}

TEST_CASE("cost: a shift with the size of the gas is found, with its error") {
  const Assessment assessment = assess(two_sizes());
  const auto shift = std::ranges::find_if(assessment.shifts, [](const Shift& each) {
    return each.cause == Cause::finite_size && each.quantity == a2;
  });
  REQUIRE(shift != assessment.shifts.end());
  CHECK(shift->change == "N = 1 000, not N = 4 000");
  CHECK(std::abs(shift->value - 0.01) < 4 * shift->error);
  CHECK(shift->error == Approx(std::hypot(0.02, 0.01) / 16).epsilon(0.2));
  CHECK(finite_size_error(assessment, of_size(assessment, 1000)) == Approx(0.01).epsilon(0.6));
  CHECK(finite_size_error(assessment, of_size(assessment, 4000)) == 0);
}

TEST_CASE("cost: an accuracy that a small gas cannot reach takes the larger one") {
  const auto series = two_sizes();
  const Assessment assessment = assess(series);
  const std::string key = gas_key(series.front().job);
  const auto rough = cheapest(assessment, key, a2, 0.05);
  REQUIRE(rough);
  CHECK(rough->job.particles == 1000);
  CHECK(rough->realizations == 2);
  const auto fine = cheapest(assessment, key, a2, 5e-4);
  REQUIRE(fine);
  CHECK(fine->job.particles == 4000);
  CHECK(fine->realizations == Approx(400).epsilon(0.4));
  CHECK(fine->cpu_seconds == Approx(0.5 * static_cast<double>(fine->realizations)));
}

TEST_CASE("cost: what the store says nothing of is named") {
  const auto unknown = assess(two_sizes()).unknown;
  CHECK(std::ranges::count(unknown, Cause::finite_size) == 0);
  CHECK(std::ranges::count(unknown, Cause::equilibration) == 1);
  CHECK(std::ranges::count(unknown, Cause::mesh) == 1);
}

TEST_CASE("cost: one realization has its error from blocks, with their correlation time") {
  schema::Job job{.e = 0.9, .n = 0.4, .particles = 1000, .sample_every = 0.25};
  Pilot pilot{.seed = 1, .tau_max = 15};
  Gaussian gaussian(3);
  for (int k = 0; k <= 60; ++k)
    pilot.samples.push_back({.tau = 0.25 * k, .a2 = -0.03 + 0.01 * gaussian()});
  const auto error = error_within(a2, job, pilot);
  REQUIRE(error);
  CHECK(error->standard_error == Approx(0.01 / std::sqrt(41.0)).epsilon(0.5));
  CHECK(error->correlation_time == Approx(0.5 * 0.25).epsilon(0.5));
  job.sample_every = 1;
  std::erase_if(pilot.samples, [](const schema::Sample& s) { return s.tau != std::round(s.tau); });
  CHECK_FALSE(error_within(a2, job, pilot));  // eleven samples show no correlation time
}

TEST_CASE("cost: what wider cells do to a correlation is the difference of the same states") {
  auto series = two_sizes();
  for (PilotSeries& each : series)
    for (std::size_t k = 0; k < each.pilots.size(); ++k) {
      const double value = static_cast<double>(k % 7);
      each.pilots[k].mesh = {.usual = {"G_parallel", 15, {4, 6}, {value, value}},
                             .wide = {"G_parallel", 15, {4, 6}, {value - 0.5, value - 0.5}}};
    }
  const Assessment assessment = assess(series);
  const auto shift = std::ranges::find_if(
      assessment.shifts, [](const Shift& each) { return each.cause == Cause::mesh; });
  REQUIRE(shift != assessment.shifts.end());
  CHECK(shift->value == Approx(-0.5));
  CHECK(shift->error < 1e-12);
}

TEST_CASE("cost: writes a table, a CSV of whole rows, and pictures") {
  const TemporaryFolder folder;
  schema::Store store = schema::Store::create(":memory:");
  add_finished(store, 0.9, 0.4, 1000, 8, 20);
  add_finished(store, 0.9, 0.4, 4000, 4, 20);
  std::ostringstream report;
  const int exit_code = cost(store, {.out = folder.path() / "cost", .targets = {}}, report);
  CHECK(report.str().find("a2, tau 5 to 15") != std::string::npos);
  CHECK(report.str().find("finite size") != std::string::npos);
  CHECK(report.str().find("The cheapest way to an error") != std::string::npos);
  std::istringstream csv(text_of(folder.path() / "cost" / "cost.csv"));
  std::string head, line;
  std::getline(csv, head);
  while (std::getline(csv, line)) {
    const auto quote = line.find('"');
    if (quote != std::string::npos)
      line.erase(quote, line.find('"', quote + 1) - quote);  // commas within do not separate
    CAPTURE(line);
    CHECK(std::ranges::count(line, ',') == std::ranges::count(head, ','));
  }
  if (exit_code == 0)  // gnuplot is installed
    CHECK(std::filesystem::file_size(folder.path() / "cost" / "cost-e0.90-n0.40.svg") > 1000);
}

TEST_CASE("cost: advice for the error asked for") {
  const TemporaryFolder folder;
  schema::Store store = schema::Store::create(":memory:");
  add_finished(store, 0.9, 0.4, 1000, 8, 20);
  std::ostringstream report;
  cost(store, {.out = folder.path(), .targets = {{"a2", 2e-4}}}, report);
  CHECK(report.str().find("2.0e-04") != std::string::npos);
}

TEST_CASE("cost: an empty store says what to plan") {
  const TemporaryFolder folder;
  const schema::Store store = schema::Store::create(":memory:");
  std::ostringstream report;
  CHECK(cost(store, {.out = folder.path() / "cost", .targets = {}}, report) == 1);
  CHECK(report.str().find("\"seeds\"") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(folder.path() / "cost"));
}

TEST_CASE("cost: targets are a quantity and an error") {
  CHECK(target_from_text("a2=5e-4") == std::pair(std::string("a2"), 5e-4));
  for (const char* text : {"a2", "a2=", "a2=0", "a2=-1", "a2=x", "b=1", "a2=1x"}) {
    CAPTURE(text);
    CHECK_FALSE(target_from_text(text));
  }
}
