// SPDX-License-Identifier: GPL-3.0-or-later

// Stores that look like those of a campaign, made from theory and noise, for tests of code that
// reads results.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "analysis/theory/cooling.hpp"
#include "analysis/theory/correlations.hpp"
#include "analysis/theory/energy_equation.hpp"
#include "analysis/theory/enskog_boltzmann.hpp"
#include "schema/store/store.hpp"
#include "support/random.hpp"

namespace haff::campaign {

// A gas whose energy obeys the energy equation (with the loss of Enskog-Boltzmann theory), and
// whose a_2 leaves the Gaussian as Enskog and Boltzmann have it and returns with the correlations;
// errors as those of N particles.
class SyntheticGas {
 public:
  SyntheticGas(schema::Job job, double tau_max) : job_(std::move(job)), tau_max_(tau_max) {}

  std::vector<schema::Sample> samples() {
    std::vector<double> tau;
    for (int k = 0; k * job_.sample_every <= tau_max_; ++k) tau.push_back(k * job_.sample_every);
    const auto theory =
        analysis::energy_equation({.e = *job_.e, .n = job_.n}, tau, analysis::cutoff_b,
                                  analysis::Velocities::enskog_boltzmann);
    const double noise = 1 / std::sqrt(static_cast<double>(job_.particles));

    std::vector<schema::Sample> all;
    double drift = 0;  // of ln E: wanders as the correlations of one realization do
    double before = 1;
    for (std::size_t k = 0; k < tau.size(); ++k) {
      const double correlated = 1 - theory[k].gamma_ratio;
      drift += noise * gaussian_() * correlated;
      const double energy = theory[k].energy * std::exp(drift);
      schema::Sample sample{.tau = tau[k], .time = tau[k] / 5, .temperature = energy * 2 / 3};
      if (k > 0) {
        sample.gamma_ratio =
            analysis::gamma_ratio(before, energy, job_.sample_every, *job_.e) + noise * gaussian_();
      }
      before = energy;
      const double a2 = analysis::boltzmann_a2(tau[k], *job_.e) * std::exp(-3 * correlated);
      sample.a2 = a2 + 0.73 * noise * gaussian_();
      sample.a3 = 0.35 * a2 + 0.68 * noise * gaussian_();
      sample.a4 = -0.1 * a2 + 0.64 * noise * gaussian_();
      if (job_.profiles_every && std::fmod(tau[k], *job_.profiles_every) == 0) {
        sample.correlation_trace =
            analysis::correlation_trace({.e = *job_.e, .n = job_.n}, tau[k]) *
            (1 + noise * gaussian_());
        sample.largest_cluster = std::min(1.0, 1e-4 * std::exp(0.05 * tau[k]));
      }
      all.push_back(sample);
    }
    return all;
  }

 private:
  schema::Job job_;
  double tau_max_;
  tests::Normal gaussian_{job_.seed * 1000003 + static_cast<std::uint64_t>(*job_.e * 1e6)};
};

// The correlations of such a gas where profiles are taken: incompressible theory, with errors.
class SyntheticProfiles {
 public:
  SyntheticProfiles(const schema::Job& job, double tau_max) : job_(job), tau_max_(tau_max) {}

  std::vector<schema::Profile> profiles() {
    std::vector<schema::Profile> all;
    if (!job_.profiles_every) return all;
    for (double tau = 0; tau <= tau_max_; tau += *job_.profiles_every) {
      all.push_back(rho(tau));
      all.push_back(correlation("G_parallel", tau));
      all.push_back(correlation("G_perpendicular", tau));
      all.push_back(structure(tau));
    }
    return all;
  }

  // A shear wave along x with random flow around it.
  std::vector<schema::Field> fields() {
    std::vector<schema::Field> all;
    for (const double tau : job_.fields_at) {
      constexpr int cells = 16;
      const double v0 = std::sqrt(2 * analysis::haff_temperature(tau, *job_.e));
      schema::Field u{
          .name = "velocity", .tau = tau, .cells = cells, .components = 3, .box = box()};
      schema::Field n{.name = "density", .tau = tau, .cells = cells, .box = box()};
      schema::Field T{.name = "temperature", .tau = tau, .cells = cells, .box = box()};
      for (int i = 0; i < cells; ++i)
        for (int jk = 0; jk < cells * cells; ++jk) {
          const double wave = std::sin(2 * std::numbers::pi * i / cells);
          for (const double mean : {0.0, v0 * wave, 0.0})
            u.values.push_back(mean + 0.2 * v0 * gaussian_());
          n.values.push_back(job_.n * (1 + 0.05 * gaussian_()));
          T.values.push_back(0.5 * v0 * v0 * (1 + 0.1 * gaussian_()));
        }
      all.insert(all.end(), {u, n, T});
    }
    return all;
  }

 private:
  double box() const { return std::cbrt(job_.particles / job_.n); }

  schema::Profile rho(double tau) {
    schema::Profile profile{.name = "rho", .tau = tau};
    const double a2 = analysis::boltzmann_a2(tau, *job_.e);
    for (int i = 0; i < 50; ++i) {
      const double c = 0.05 + 0.1 * i, c2 = c * c;
      const double expected = std::exp(-c2) * (1 + a2 * (0.5 * c2 * c2 - 2.5 * c2 + 15.0 / 8));
      const double count = std::max(1.0, job_.particles * expected * c2 * 0.1);
      profile.x.push_back(c);
      profile.value.push_back(std::max(0.0, expected * (1 + gaussian_() / std::sqrt(count))));
    }
    return profile;
  }

  schema::Profile correlation(const std::string& name, double tau) {
    schema::Profile profile{.name = name, .tau = tau};
    const double noise = analysis::haff_temperature(tau, *job_.e) * 1e-4;
    for (double r = 1.5; r <= box() / 2; r += 1) {
      const auto theory = analysis::velocity_correlation({.e = *job_.e, .n = job_.n}, r, tau,
                                                         analysis::Fluid::incompressible);
      profile.x.push_back(r);
      profile.value.push_back((name == "G_parallel" ? theory.parallel : theory.perpendicular) +
                              noise * gaussian_());
    }
    return profile;
  }

  schema::Profile structure(double tau) {
    schema::Profile profile{.name = "S", .tau = tau};
    for (int i = 1; i < 20; ++i) {
      const double k = i * 2 * std::numbers::pi / box();
      profile.x.push_back(k);
      profile.value.push_back((0.05 + 0.01 * tau * std::exp(-k * k)) * (1 + 0.05 * gaussian_()));
    }
    return profile;
  }

  schema::Job job_;
  double tau_max_;
  tests::Normal gaussian_{job_.seed * 7919 + 1};
};

// Adds finished realizations of a gas, seeds 1 ... K in place of the job's own.
inline void add_finished(schema::Store& store, schema::Job job, int seeds, double tau_max) {
  const schema::Owner owner{.host = "here", .boot_id = "boot", .pid = 1, .started = 1};
  std::vector<schema::Planned> plan;
  for (int seed = 1; seed <= seeds; ++seed) {
    job.seed = static_cast<std::uint64_t>(seed);
    plan.push_back({.job = schema::equilibration_of(job), .tau_max = job.equilibrate});
    plan.push_back({.job = job, .tau_max = tau_max});
  }
  store.add(plan);
  while (const auto claim = store.claim(owner, "synthetic")) {
    schema::Commit last{
        .checkpoint = schema::Checkpoint{.tau = claim->tau_max},
        .progress = {.tau = claim->tau_max,
                     .cpu_seconds = 0.5e-6 * claim->tau_max * claim->job.particles}};
    std::optional<schema::Results> results;
    if (claim->job.kind == schema::Kind::cooling) {
      last.samples = SyntheticGas(claim->job, claim->tau_max).samples();
      SyntheticProfiles space(claim->job, claim->tau_max);
      last.profiles = space.profiles();
      last.fields = space.fields();
      std::vector<double> tau, temperature;
      for (const auto& sample : last.samples) {
        tau.push_back(sample.tau);
        temperature.push_back(*sample.temperature);
      }
      results = schema::Results{.tau_c = analysis::tau_c(tau, temperature, *claim->job.e)};
    }
    store.finish(claim->lease, last, results, claim->tau_max);
  }
}

inline void add_finished(schema::Store& store, double e, double n, std::uint32_t particles,
                         int seeds, double tau_max, double sample_every = 1) {
  add_finished(store,
               {.e = e,
                .n = n,
                .particles = particles,
                .sample_every = sample_every,
                .observables = {"laguerre", "temperature"}},
               seeds, tau_max);
}

// The same with everything that can be observed.
inline void add_finished_with_profiles(schema::Store& store, double e, double n,
                                       std::uint32_t particles, int seeds, double tau_max,
                                       double profiles_every, std::vector<double> fields_at) {
  add_finished(store,
               {.e = e,
                .n = n,
                .particles = particles,
                .observables = {"clusters", "correlations", "distribution", "fields", "laguerre",
                                "structure", "temperature"},
                .profiles_every = profiles_every,
                .fields_at = std::move(fields_at)},
               seeds, tau_max);
}

// Enough of the paper's scenes for its figures.
inline schema::Store first_campaign(int seeds = 2) {
  auto store = schema::Store::in_memory();
  add_finished(store, 0.8, 0.4, 2000, seeds, 90);
  add_finished(store, 0.9, 0.4, 2000, seeds, 180);
  add_finished(store, 0.85, 0.2, 2000, seeds, 40);
  add_finished_with_profiles(store, 0.8, 0.4, 3000, 1, 60, 10, {60});
  return store;
}

}  // namespace haff::campaign
