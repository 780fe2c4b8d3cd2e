#include "campaign/planning/calibration.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "campaign/base/cpu_time.hpp"
#include "campaign/job/measurement.hpp"
#include "campaign/state/checkpoint.hpp"
#include "campaign/state/model.hpp"
#include "engine/initial.hpp"
#include "engine/simulation.hpp"

namespace haff::campaign {
namespace {

constexpr std::uint32_t largest = 200'000;
constexpr double densest = 0.9;

// Large enough to tell the memory of a particle in a larger one, too.
constexpr std::uint32_t small_gas = 16'000;

// Between two looks at the clock, where samples do not come more often; and the least that is run,
// so that effects which act once per collision and particle are seen. [collisions per particle]
constexpr double stretch = 1;

// Measured with N = 32 000: to store a state takes so many times what encoding it does (the
// checksum and SQLite's way to the disk), to read one back and check it half of that.
constexpr double storing = 8;
constexpr double reading = 4;

schema::Job tried_for(schema::Job job, std::uint32_t most) {
  job.n = std::min(job.n, densest);
  job.particles = std::min(job.particles, most);
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

// One look at the gas that takes what `views` asks for, as every job's first sample does.
double price_of(const engine::Simulation& gas, const schema::Job& views) {
  schema::Sample sample;
  Stopwatch watch;
  view(gas, views, sample);
  return watch.lap();
}

}  // namespace

Prices try_out(const schema::Job& job, double tau_max, double seconds) {
  const schema::Job tried = tried_for(job, largest);
  Prices prices;
  Stopwatch watch;
  const engine::State state = first_state(tried);
  const double making = watch.lap();
  encode(state);
  const double encoding = watch.lap();
  prices.commit = storing * encoding;
  engine::Simulation gas(model_of(tried), state);
  // A simulation begins as after a synchronization.
  prices.synchronization = watch.lap();
  prices.start = prices.synchronization +
                 (job.kind == schema::Kind::equilibration ? making : reading * encoding);

  const double step = std::min(job.sample_every, stretch);
  std::vector<schema::Sample> rows;
  double tau = 0, running = 0, sampling = 0;
  int samples = 0;
  do {
    rows.push_back(measure(gas, tried, tau, rows));
    ++samples;
    sampling += watch.lap();
    tau = step * samples;
    try {
      gas.run_to(engine::collisions_at(tau, tried.particles));
    } catch (const std::runtime_error&) {
      tau_max = 0;  // collapse or breakdown: the end of the trial, and of the job
    }
    running += watch.lap();
  } while (tau < tau_max && (tau < stretch || running + sampling < seconds));
  prices.sample = sampling / samples;
  const double synchronized = std::floor(tau / engine::synchronization_period);
  prices.collision = std::max(0.0, running - synchronized * prices.synchronization) /
                     static_cast<double>(std::max<std::int64_t>(1, gas.collisions()));
  schema::Job views = tried;
  if (job.profiles_every) {
    views.fields_at.clear();
    prices.profiles = price_of(gas, views);
  }
  if (!job.fields_at.empty()) {
    views.profiles_every = std::nullopt;
    views.fields_at = {0};
    prices.fields = price_of(gas, views);
  }
  const double scale = static_cast<double>(job.particles) / tried.particles;
  for (double* each : {&prices.start, &prices.synchronization, &prices.sample, &prices.profiles,
                       &prices.fields, &prices.commit})
    *each *= scale;
  return prices;
}

double bytes_per_particle(const schema::Job& job) {
  const schema::Job tried = tried_for(job, small_gas);
  const engine::Simulation gas(model_of(tried), first_state(tried));
  return static_cast<double>(gas.memory()) / tried.particles;
}

}  // namespace haff::campaign
