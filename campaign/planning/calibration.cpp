// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/planning/calibration.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

#include "campaign/base/process/cpu_time.hpp"
#include "campaign/job/measurement.hpp"
#include "campaign/job/views.hpp"
#include "campaign/state/checkpoint.hpp"
#include "campaign/state/model.hpp"
#include "engine/initial.hpp"
#include "engine/simulation.hpp"

namespace haff::campaign {
namespace {

constexpr std::uint32_t largest = 200'000;
constexpr double densest = 0.9;

// Growth takes a millisecond a particle near random close packing. This many particles tell what
// one of a larger gas costs, or as many as make a box of this width, in which the search need not
// look at images. [sigma]
constexpr std::uint32_t most_grown = 500;
constexpr double widest_grown = 7;

// A shorter action is repeated, so that what happens once in a process (the first use of code and
// memory, the plans of FFTW) is not counted for every job. [s]
constexpr double long_enough = 5e-3;

// A gas large enough to tell the memory of a particle in a larger one.
constexpr std::uint32_t small_gas = 16'000;

// The stretch between two looks at the clock, unless samples come more often; and the least that is
// run, so that effects which act once per collision and particle are seen. [collisions per
// particle]
constexpr double stretch = 1;

// The times to store a state (the checksum, SQLite and the disk), and to read one back and check
// it, in units of the time to encode it; measured with N = 32 000.
constexpr double storing = 8;
constexpr double reading = 4;

// The gas that is tried in place of the job's: prepared in the same way, on a lattice or by growth.
schema::Job tried_for(schema::Job job, std::uint32_t most) {
  if (engine::begins_on_lattice(job.n, job.particles, job.d)) {
    job.n = std::min(job.n, densest);
    job.particles = std::min(job.particles, most);
    return job;
  }
  const double wide = job.n * std::pow(widest_grown, job.d);
  job.particles = std::min(job.particles, std::max(most_grown, static_cast<std::uint32_t>(wide)));
  while (engine::begins_on_lattice(job.n, job.particles, job.d)) ++job.particles;
  return job;
}

engine::State first_state(const schema::Job& job) {
  return engine::initial_state(job.n, job.particles, job.seed, job.d, model_of(job).effects);
}

// CPU time since it was last asked.
class Stopwatch {
 public:
  double lap() {
    const double now = cpu_seconds();
    return now - std::exchange(before_, now);
  }

 private:
  double before_ = cpu_seconds();
};

// CPU time of an action that is not the first of its kind. [s]
template <class Action>
double price_of(Action&& action) {
  Stopwatch watch;
  action();
  double sum = watch.lap(), repeats = 1;
  if (sum >= long_enough) return sum;
  for (sum = 0, repeats = 0; sum < long_enough && repeats < 100; ++repeats) {
    action();
    sum += watch.lap();
  }
  return sum / repeats;
}

// CPU time of what `views` asks for, taken once, as with the first sample of every job.
double price_of_view(const engine::Simulation& gas, const schema::Job& views) {
  return price_of([&] {
    schema::Sample sample;
    view(gas, views, sample);
  });
}

// The cost of running and sampling.
struct Trial {
  double running = 0, sampling = 0;  // [s]
  double samples = 0, collisions = 0, synchronizations = 0;
};

// Runs the gas from its first state for some seconds, at most to tau_max.
Trial run_once(const schema::Job& job, const engine::State& state, double tau_max, double seconds) {
  Trial trial;
  engine::Simulation gas(model_of(job), state);
  const double step = std::min(job.sample_every, stretch);
  std::vector<schema::Sample> rows;
  Stopwatch watch;
  double tau = 0;
  do {
    rows.push_back(measure(gas, job, tau, rows));
    ++trial.samples;
    trial.sampling += watch.lap();
    tau = step * trial.samples;
    try {
      gas.run_to(engine::collisions_at(tau, job.particles));
    } catch (const std::runtime_error&) {
      tau_max = 0;  // a collapse or an error: the end of the trial, and of the job
    }
    trial.running += watch.lap();
  } while (tau < tau_max && (tau < stretch || trial.running + trial.sampling < seconds));
  trial.collisions = static_cast<double>(gas.collisions());
  trial.synchronizations = std::floor(tau / engine::synchronization_period);
  return trial;
}

}  // namespace

Prices try_out(const schema::Job& job, double tau_max, double seconds) {
  const schema::Job tried = tried_for(job, largest);
  Prices prices;
  engine::State state;
  const double making = price_of([&] { state = first_state(tried); });
  const double encoding = price_of([&] { encode(state); });
  prices.commit = storing * encoding;
  // A simulation begins as after a synchronization.
  prices.synchronization = price_of([&] { engine::Simulation(model_of(tried), state); });
  prices.start = prices.synchronization +
                 (job.kind == schema::Kind::equilibration ? making : reading * encoding);

  Trial sum = run_once(tried, state, tau_max, seconds);
  if (sum.running + sum.sampling < long_enough) {
    sum = {};
    for (int k = 0; k < 100 && sum.running + sum.sampling < long_enough; ++k) {
      const Trial once = run_once(tried, state, tau_max, seconds);
      sum.running += once.running;
      sum.sampling += once.sampling;
      sum.samples += once.samples;
      sum.collisions += once.collisions;
      sum.synchronizations += once.synchronizations;
    }
  }
  prices.sample = sum.sampling / sum.samples;
  prices.collision = std::max(0.0, sum.running - sum.synchronizations * prices.synchronization) /
                     std::max(1.0, sum.collisions);

  schema::Job views = tried;
  const engine::Simulation gas(model_of(tried), state);
  if (job.profiles_every) {
    views.fields_at.clear();
    prices.profiles = price_of_view(gas, views);
  }
  if (!job.fields_at.empty()) {
    views.profiles_every = std::nullopt;
    views.fields_at = {0};
    prices.fields = price_of_view(gas, views);
  }
  const double scale = static_cast<double>(job.particles) / tried.particles;
  for (double* each : {&prices.start, &prices.synchronization, &prices.sample, &prices.profiles,
                       &prices.fields, &prices.commit})
    *each *= scale;
  return prices;
}

Sizes sizes(const schema::Job& job) {
  const schema::Job tried = tried_for(job, small_gas);
  const engine::Simulation gas(model_of(tried), first_state(tried));
  return {.engine = static_cast<double>(gas.memory()) / tried.particles,
          .state = static_cast<double>(encode(gas.state()).size()) / tried.particles};
}

}  // namespace haff::campaign
