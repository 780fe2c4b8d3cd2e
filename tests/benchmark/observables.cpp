// SPDX-License-Identifier: GPL-3.0-or-later

// The cost of observables: the CPU time of one sample of each observable of the whole gas, and the
// time that is added to a collision by those that follow particles or count collisions; a table
// (Markdown).
//
//   build/release/tests/observables_benchmark [N]
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "campaign/base/process/cpu_time.hpp"
#include "campaign/job/collisions.hpp"
#include "campaign/job/diffusion.hpp"
#include "campaign/job/measurement.hpp"
#include "campaign/job/views.hpp"
#include "campaign/state/model.hpp"
#include "engine/initial.hpp"
#include "engine/simulation.hpp"

using namespace haff;
using namespace haff::campaign;

namespace {

constexpr double warm_up = 10;       // [collisions per particle]
constexpr double long_enough = 0.3;  // duration of a measurement [s]
constexpr int repeats = 5;           // the fastest one counts, which is the least disturbed

schema::Job job_with(std::vector<std::string> observables, std::uint32_t particles) {
  schema::Job job;
  job.e = 0.85;
  job.n = 0.4;
  job.particles = particles;
  job.seed = 1;
  job.observables = std::move(observables);
  job.profiles_every = 1;
  job.fields_at = {0};
  return job;
}

template <class Action>
double seconds_of(const Action& action) {
  double least = 1e9;
  for (int k = 0; k < repeats; ++k) {
    int count = 0;
    const double begin = cpu_seconds();
    do {
      action();
      ++count;
    } while (cpu_seconds() - begin < long_enough / repeats);
    least = std::min(least, (cpu_seconds() - begin) / count);
  }
  return least;
}

// The CPU time per collision in a gas whose particles and collisions are observed for the job. [s]
double seconds_per_collision(const schema::Job& job, const engine::State& state) {
  double least = 1e9;
  for (int k = 0; k < repeats; ++k) {
    engine::Simulation gas(model_of(job), state);
    Diffusion diffusion(job);
    diffusion.begin(gas, state);
    diffusion.sample(gas, 0);
    const std::int64_t end = gas.collisions() + engine::collisions_at(warm_up, job.particles);
    const std::int64_t count = end - gas.collisions();
    const double begin = cpu_seconds();
    while (gas.collisions() < end) {
      gas.run_to(std::min(end, diffusion.next_look()));
      if (gas.collisions() == diffusion.next_look()) diffusion.look(gas);
    }
    least = std::min(least, (cpu_seconds() - begin) / static_cast<double>(count));
  }
  return least;
}

}  // namespace

int main(int argc, char** argv) {
  const auto particles = static_cast<std::uint32_t>(argc > 1 ? std::stoul(argv[1]) : 32'000);
  const schema::Job plain = job_with({"temperature"}, particles);
  engine::Simulation gas(model_of(plain), engine::initial_state(plain.n, particles, plain.seed));
  gas.run_to(engine::collisions_at(warm_up, particles));
  const engine::State state = gas.state();
  const double collision = seconds_per_collision(plain, state);

  fmt::print("N = {}, n = 0.4, e = 0.85: {:.2f} us a collision\n\n", particles, 1e6 * collision);
  fmt::print(
      "| observable | ms a sample | as much as so many collisions per particle | added to a "
      "collision |\n| --- | --- | --- | --- |\n");
  const double per_particle = collision * particles / 2;  // [s] of tau = 1
  for (const char* name : {"temperature", "laguerre"}) {
    const schema::Job job = job_with({name}, particles);
    const double seconds = seconds_of([&] { measure(gas, job, 0, {}); });
    fmt::print("| `{}` | {:.2f} | {:.2f} | |\n", name, 1e3 * seconds, seconds / per_particle);
  }
  for (const char* name : {"distribution", "tail", "correlations", "structure", "pair_distribution",
                           "energy_spectrum", "clusters", "cluster_sizes", "fields"}) {
    const schema::Job job = job_with({name}, particles);
    const double seconds = seconds_of([&] {
      schema::Sample sample;
      view(gas, job, sample);
    });
    fmt::print("| `{}` | {:.2f} | {:.2f} | |\n", name, 1e3 * seconds, seconds / per_particle);
  }
  for (const char* name : {"msd", "vacf", "collision_statistics"}) {
    const schema::Job job = job_with({name}, particles);
    engine::Simulation observed(model_of(job), state);
    Diffusion diffusion(job);
    diffusion.begin(observed, state);
    const double seconds = seconds_of([&] {
      diffusion.sample(observed, 0);
      collision_statistics(observed, job, 0);
    });
    fmt::print("| `{}` | {:.2f} | {:.2f} | {:+.1f} % |\n", name, 1e3 * seconds,
               seconds / per_particle, 100 * (seconds_per_collision(job, state) / collision - 1));
  }
}
