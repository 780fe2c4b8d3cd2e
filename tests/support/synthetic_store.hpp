// Stores that look like a campaign's, made from theory and noise: for what reads results and does
// not care where they come from.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

#include "analysis/cooling.hpp"
#include "analysis/energy_equation.hpp"
#include "analysis/enskog_boltzmann.hpp"
#include "schema/store.hpp"

namespace haff::campaign {

// A gas whose energy obeys the energy equation, and whose a_2 leaves the Gaussian as Enskog and
// Boltzmann have it and returns with the correlations; errors as those of N particles.
class SyntheticGas {
 public:
  SyntheticGas(schema::Job job, double tau_max) : job_(std::move(job)), tau_max_(tau_max) {}

  std::vector<schema::Sample> samples() {
    std::vector<double> tau;
    for (int k = 0; k * job_.sample_every <= tau_max_; ++k) tau.push_back(k * job_.sample_every);
    const auto theory = analysis::energy_equation({.e = job_.e, .n = job_.n}, tau);
    const double noise = 1 / std::sqrt(static_cast<double>(job_.particles));

    std::vector<schema::Sample> all;
    double drift = 0;  // of ln E: wanders as the correlations of one realization do
    double before = 1;
    for (std::size_t k = 0; k < tau.size(); ++k) {
      const double correlated = 1 - theory[k].gamma_ratio;
      drift += noise * gaussian() * correlated;
      const double energy = theory[k].energy * std::exp(drift);
      schema::Sample sample{.tau = tau[k], .time = tau[k] / 5, .temperature = energy * 2 / 3};
      if (k > 0) {
        sample.gamma_ratio =
            analysis::gamma_ratio(before, energy, job_.sample_every, job_.e) + noise * gaussian();
      }
      before = energy;
      const double a2 = analysis::boltzmann_a2(tau[k], job_.e) * std::exp(-3 * correlated);
      sample.a2 = a2 + 0.73 * noise * gaussian();
      sample.a3 = 0.35 * a2 + 0.68 * noise * gaussian();
      sample.a4 = -0.1 * a2 + 0.64 * noise * gaussian();
      all.push_back(sample);
    }
    return all;
  }

 private:
  // splitmix64 and Box-Muller.
  double uniform() {
    std::uint64_t z = (random_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (static_cast<double>((z ^ (z >> 31)) >> 11) + 0.5) * 0x1p-53;
  }
  double gaussian() {
    return std::sqrt(-2 * std::log(uniform())) * std::cos(6.283185307179586 * uniform());
  }

  schema::Job job_;
  double tau_max_;
  std::uint64_t random_ = job_.seed * 1000003 + static_cast<std::uint64_t>(job_.e * 1e6);
};

// Adds finished realizations of one gas, seeds 1 ... K.
inline void add_finished(schema::Store& store, double e, double n, std::uint32_t particles,
                         int seeds, double tau_max, double sample_every = 1) {
  const schema::Owner owner{.host = "here", .boot_id = "boot", .pid = 1, .started = 1};
  std::vector<schema::Planned> plan;
  for (int seed = 1; seed <= seeds; ++seed) {
    schema::Job job{.e = e,
                    .n = n,
                    .particles = particles,
                    .seed = static_cast<std::uint64_t>(seed),
                    .sample_every = sample_every,
                    .observables = {"laguerre", "temperature"}};
    plan.push_back({.job = schema::equilibration_of(job), .tau_max = job.equilibrate});
    plan.push_back({.job = job, .tau_max = tau_max});
  }
  store.add(plan);
  while (const auto claim = store.claim(owner, "synthetic")) {
    schema::Commit last{.checkpoint = schema::Checkpoint{.tau = claim->tau_max},
                        .progress = {.tau = claim->tau_max}};
    std::optional<schema::Results> results;
    if (claim->job.kind == schema::Kind::cooling) {
      last.samples = SyntheticGas(claim->job, claim->tau_max).samples();
      std::vector<double> tau, temperature;
      for (const auto& sample : last.samples) {
        tau.push_back(sample.tau);
        temperature.push_back(*sample.temperature);
      }
      results = schema::Results{.tau_c = analysis::tau_c(tau, temperature, claim->job.e)};
    }
    store.finish(claim->lease, last, results, claim->tau_max);
  }
}

}  // namespace haff::campaign
