// SPDX-License-Identifier: GPL-3.0-or-later

// The sources of error, in artificial gases whose errors are known.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "campaign/accuracy/offer.hpp"
#include "support/synthetic_store.hpp"

using namespace haff;
using namespace haff::campaign;
using doctest::Approx;

namespace {

constexpr Quantity a2{.measure = Measure::a2, .from = 5, .to = 15};

// Realizations whose a2 is constant in tau: `mean` plus normal noise.
FinishedSeries gas(std::uint32_t particles, std::size_t realizations, double mean, double deviation,
                   double cpu_seconds) {
  FinishedSeries series{
      .job = {.e = 0.9, .n = 0.4, .particles = particles, .observables = {"laguerre"}}, .runs = {}};
  tests::Normal gaussian(particles);
  for (std::size_t k = 0; k < realizations; ++k) {
    FinishedRun run{.seed = k + 1, .tau_max = 15, .cpu_seconds = cpu_seconds};
    const double value = mean + deviation * gaussian();
    for (int tau = 0; tau <= 15; ++tau)
      run.samples.push_back({.tau = static_cast<double>(tau), .a2 = value});
    series.runs.push_back(run);
  }
  return series;
}

// a2 = -0.04, and larger by 0.01 in the small box; the noise is proportional to N^-1/2.
std::vector<FinishedSeries> two_sizes() {
  return {gas(1000, 256, -0.03, 0.02, 0.1), gas(4000, 256, -0.04, 0.01, 0.5)};
}

const Statistics& of_size(const Assessment& assessment, std::uint32_t particles) {
  return *std::ranges::find_if(assessment.statistics, [&](const Statistics& each) {
    return each.quantity == a2 && each.job.particles == particles;
  });
}

}  // namespace

TEST_CASE("assessment: errors of independent realizations fall as one over the root") {
  const Assessment assessment = assess(two_sizes());
  const Statistics& small = of_size(assessment, 1000);
  CHECK(small.realizations == 256);
  CHECK(small.error == Approx(0.02 / 16).epsilon(0.2));  // four errors of the error: 18 %
  CHECK(small.cpu_seconds == Approx(0.1));
  REQUIRE(small.slope);
  CHECK(std::abs(small.slope->value + 0.5) < 4 * small.slope->error);
  CHECK(small.half_interval == Approx(1.97 * small.error).epsilon(0.01));
}

TEST_CASE("assessment: a shift with the size of the gas is found, with its error") {
  const Assessment assessment = assess(two_sizes());
  const auto shift = std::ranges::find_if(assessment.shifts, [](const BiasEstimate& each) {
    return each.cause == SystematicEffect::finite_size && each.quantity == a2;
  });
  REQUIRE(shift != assessment.shifts.end());
  CHECK(shift->change == "N = 1 000, not N = 4 000");
  CHECK(std::abs(shift->value - 0.01) < 4 * shift->error);
  CHECK(shift->error == Approx(std::hypot(0.02, 0.01) / 16).epsilon(0.2));
  CHECK(finite_size_error(assessment, of_size(assessment, 1000)) == Approx(0.01).epsilon(0.6));
  CHECK(finite_size_error(assessment, of_size(assessment, 4000)) == 0);
}

TEST_CASE("assessment: an accuracy that a small gas cannot reach takes the larger one") {
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

TEST_CASE("assessment: effects about which the store has no data are named for each quantity") {
  const Assessment assessment = assess(two_sizes());
  const auto unknown = [&](SystematicEffect cause) {
    return std::ranges::count_if(assessment.unknown, [&](const UnknownBias& each) {
      return each.quantity == a2 && each.cause == cause;
    });
  };
  CHECK(unknown(SystematicEffect::finite_size) == 0);
  CHECK(unknown(SystematicEffect::equilibration) == 1);
  CHECK(unknown(SystematicEffect::sampling) == 0);
  CHECK(unknown(SystematicEffect::mesh) == 0);  // the mesh affects correlations alone
}

TEST_CASE("assessment: quantities that no run has are named, with the reason") {
  const Assessment assessment = assess(two_sizes());
  const auto absence = [&](const Quantity& quantity) {
    return std::ranges::find_if(assessment.absent,
                                [&](const NotMeasured& each) { return each.quantity == quantity; });
  };
  CHECK(absence(a2) == assessment.absent.end());
  const auto late = absence(usual_quantity(Measure::gamma_ratio, 50));
  REQUIRE(late != assessment.absent.end());
  CHECK_FALSE(late->reached);
  const auto unmeasured = absence(usual_quantity(Measure::gamma_ratio, 10));
  REQUIRE(unmeasured != assessment.absent.end());
  CHECK(unmeasured->reached);
}

TEST_CASE(
    "assessment: of two series with as many particles in all, the larger gas shows the sampling "
    "effect") {
  const Assessment assessment =
      assess({gas(1000, 64, -0.03, 0.02, 0.1), gas(4000, 16, -0.04, 0.01, 0.5)});
  bool any = false;
  for (const BiasEstimate& shift : assessment.shifts) {
    if (shift.cause != SystematicEffect::sampling && shift.cause != SystematicEffect::averaging)
      continue;
    any = true;
    CHECK(shift.job.particles == 4000);
  }
  CHECK(any);
}

TEST_CASE("assessment: a gas without the quantity is not used for it") {
  std::vector<FinishedSeries> series{gas(1000, 8, -0.03, 0.02, 0.1),
                                     gas(4000, 8, -0.04, 0.01, 0.5)};
  for (FinishedRun& run : series[1].runs)
    for (schema::Sample& sample : run.samples) sample.a2.reset();
  const Assessment assessment = assess(series);
  const auto shift = std::ranges::find_if(assessment.shifts, [](const BiasEstimate& each) {
    return each.cause == SystematicEffect::sampling && each.quantity == a2;
  });
  REQUIRE(shift != assessment.shifts.end());
  CHECK(shift->job.particles == 1000);
}

TEST_CASE("assessment: samples that are a subset of others are reported as such") {
  auto series = two_sizes();
  for (FinishedSeries& each : series)
    for (FinishedRun& run : each.runs)
      for (schema::Sample& sample : run.samples) sample.temperature = std::exp(-0.06 * sample.tau);
  const Quantity at_10 = usual_quantity(Measure::ln_temperature, 10);
  const Assessment assessment = assess(series, {}, {at_10});
  const auto shift = std::ranges::find_if(assessment.shifts, [&](const BiasEstimate& each) {
    return each.cause == SystematicEffect::sampling && each.quantity == at_10;
  });
  REQUIRE(shift != assessment.shifts.end());
  CHECK(shift->value == 0);
  CHECK(shift->change == "a sample every 2, not 1: the same samples");
}

namespace {

// One run whose a2 has the correlation function exp(-tau / 1.9), as near the Gaussian: the
// integrated correlation time is 1.94 for a sample every 1.
FinishedSeries correlated(double tau_max, double sample_every, std::uint64_t seed) {
  const double memory = std::exp(-sample_every / 1.9);
  FinishedSeries series{.job = {.e = 0.9,
                                .n = 0.4,
                                .particles = 1000,
                                .sample_every = sample_every,
                                .observables = {"laguerre"}},
                        .runs = {{.seed = 1, .tau_max = tau_max, .cpu_seconds = 1}}};
  tests::Normal gaussian(seed);
  double a2_now = gaussian();
  for (double tau = 0; tau <= tau_max; tau += sample_every) {
    series.runs[0].samples.push_back({.tau = tau, .a2 = -0.03 + 0.01 * a2_now});
    a2_now = memory * a2_now + std::sqrt(1 - memory * memory) * gaussian();
  }
  return series;
}

}  // namespace

TEST_CASE("assessment: the error of a single run is the scatter of its window's mean") {
  // The scatter of 400 values is known to 3.5 %; blocks of eight correlation times may be too small
  // by a tenth.
  for (const double sample_every : {0.25, 1.0}) {
    double squares = 0, claimed = 0;
    std::size_t runs = 0;
    for (std::uint64_t seed = 1; seed <= 400; ++seed) {
      const FinishedSeries series = correlated(340, sample_every, seed);
      const auto error = error_within(a2, series.job, series.runs[0]);
      if (!error) continue;
      ++runs;
      squares += std::pow(value_of(a2, series.job, series.runs[0]).value() + 0.03, 2);
      claimed += std::pow(error->standard_error, 2);
    }
    CAPTURE(sample_every);
    CHECK(runs > 300);
    CHECK(std::sqrt(claimed / squares) == Approx(1).epsilon(0.15));
  }
}

TEST_CASE("assessment: a single run has an error with its correlation time, and advice") {
  const FinishedSeries series = correlated(340, 1, 1);
  const Assessment assessment = assess({series});
  const Statistics& single = of_size(assessment, 1000);
  CHECK(single.realizations == 1);
  REQUIRE(single.correlation_time);
  CHECK(*single.correlation_time == Approx(1.94).epsilon(0.4));
  const auto offer = cheapest(assessment, gas_key(series.job), a2, single.error / 10);
  REQUIRE(offer);
  CHECK(offer->realizations == Approx(100).epsilon(0.02));
}

TEST_CASE("assessment: a run too short to show its correlation time has no error") {
  for (const double sample_every : {0.25, 1.0})
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
      const FinishedSeries series = correlated(20, sample_every, seed);
      CHECK_FALSE(error_within(a2, series.job, series.runs[0]));
    }
}

TEST_CASE(
    "assessment: the effect of wider cells on a correlation is a difference of the same states") {
  auto series = two_sizes();
  for (FinishedSeries& each : series)  // the small gas ends where the correlation is asked for
    for (std::size_t k = 0; k < each.runs.size(); ++k) {
      const double value = static_cast<double>(k % 7);
      const double end = each.job.particles == 1000 ? 15 : 40;
      each.runs[k].correlations = {{"G_parallel", 15, {4, 6}, {value, value}}};
      each.runs[k].mesh = {.usual = {"G_parallel", end, {4, 6}, {value, value}},
                           .wide = {"G_parallel", end, {4, 6}, {value - 0.5, value - 0.5}}};
    }
  const Assessment assessment = assess(series);
  const auto shift = std::ranges::find_if(assessment.shifts, [](const BiasEstimate& each) {
    return each.cause == SystematicEffect::mesh;
  });
  REQUIRE(shift != assessment.shifts.end());
  CHECK(shift->value == Approx(-0.5));
  CHECK(shift->error < 1e-12);
  CHECK(shift->job.particles == 1000);
  CHECK(shift->quantity.to == 15);
  CHECK(shift->change.find("at tau 15") != std::string::npos);
}

TEST_CASE(
    "assessment: a target's window is one of the quantities, with an interval from the pilots") {
  const Quantity early{.measure = Measure::a2, .from = 3, .to = 8};
  const auto series = two_sizes();
  const schema::Target target{.series = schema::series_identity(series[0].job),
                              .quantity = "a2",
                              .tau_from = 3,
                              .tau_to = 8,
                              .se = 0.002,
                              .pilots = {1, 2, 3, 4, 5}};
  const Assessment assessment = assess(series, {target});
  for (const Statistics& each : assessment.statistics) {
    if (each.quantity != early) continue;
    const bool has_target = each.job.particles == 1000;
    CHECK(each.realizations == 256);
    CHECK(each.interval_runs == (has_target ? 5 : 256));
    const double usual = 1.97 * each.error;
    CHECK(each.half_interval ==
          Approx(has_target ? half_interval(target, series[0]).value() : usual).epsilon(0.01));
  }
  CHECK(std::ranges::count_if(assessment.statistics,
                              [&](const Statistics& each) { return each.quantity == early; }) == 2);
}

TEST_CASE("assessment: more runs of the largest gas are advised where its error is too large") {
  // Both sizes are equal within their errors; the small one is cheaper.
  const std::vector<FinishedSeries> series{gas(1000, 256, -0.04, 0.02, 0.1),
                                           gas(4000, 4, -0.04, 0.01, 10)};
  const Assessment assessment = assess(series);
  const std::string key = gas_key(series[0].job);
  const double uncertain = finite_size_shift(assessment, of_size(assessment, 1000))->error;
  const auto fine = cheapest(assessment, key, a2, uncertain / 2);
  REQUIRE(fine);
  CHECK(fine->job.particles == 4000);
  CHECK(fine->seen == 4);
  CHECK(smaller_might_do(assessment, key, a2, uncertain / 2) ==
        (finite_size_error(assessment, of_size(assessment, 1000)) < uncertain / 2));
  CHECK_FALSE(smaller_might_do(assessment, key, a2, 10 * uncertain));
  // In two_sizes() the small gas is known to be too small.
  CHECK_FALSE(smaller_might_do(assess(two_sizes()), key, a2, 1e-4));
}

TEST_CASE("assessment: tau_c is not averaged where some runs end before it") {
  auto series = two_sizes();
  for (FinishedSeries& each : series)
    for (std::size_t k = 0; k < each.runs.size(); ++k)
      each.runs[k].tau_c = 130 + static_cast<double>(k % 7);
  const Quantity tau_c{.measure = Measure::tau_c};
  const std::string key = gas_key(series[0].job);
  CHECK(cheapest(assess(series), key, tau_c, 1));
  for (FinishedSeries& each : series) each.runs[3].tau_c.reset();
  const Assessment assessment = assess(series);
  CHECK_FALSE(cheapest(assessment, key, tau_c, 1));
  CHECK(std::ranges::none_of(assessment.shifts,
                             [&](const BiasEstimate& shift) { return shift.quantity == tau_c; }));
  CHECK(std::ranges::any_of(assessment.statistics,
                            [](const Statistics& each) { return each.unfinished == 1; }));
}
