#include "campaign/forecast.hpp"

#include "campaign/calibration.hpp"
#include "campaign/timetable.hpp"

namespace haff::campaign {
namespace {

// CPU time below which a speed in the store says more about start-up than about collisions. [s]
constexpr double trustworthy = 0.2;

// A trial takes so long; in a plan of many gases those after the first ten take a tenth. [s]
constexpr double trial_seconds = 0.15;
constexpr std::size_t trials_at_length = 10;

// Large enough to tell the memory of a particle. [particles]
constexpr std::uint32_t small_gas = 4000;

// A particle in engine::State, which a worker that stores it holds once, and once more encoded.
constexpr double state_bytes = 52;

// A worker with no gas. [bytes]
constexpr double program_bytes = 12e6;

// One row of samples (12 numbers) and of jobs in SQLite, with their share of the index pages.
constexpr double sample_bytes = 115;
constexpr double job_bytes = 1000;

constexpr int any_kind = -1;
constexpr double any_e = -1;

int number(schema::Kind kind) {
  return kind == schema::Kind::equilibration ? 0 : 1;
}

}  // namespace

Forecast::Forecast(const std::vector<schema::JobRow>& known) {
  for (const schema::JobRow& row : known) {
    const auto& job = row.job;
    for (const Gas& gas :
         {Gas{job.d, job.n, job.particles, number(job.kind), job.e.value_or(any_e)},
          Gas{job.d, job.n, job.particles, number(job.kind), any_e},
          Gas{job.d, job.n, job.particles, any_kind, any_e}}) {
      known_[gas].collisions += static_cast<double>(row.progress.collisions);
      known_[gas].cpu_seconds += row.progress.cpu_seconds;
    }
  }
}

double Forecast::collisions_per_second(const schema::Job& job) {
  for (const Gas& gas : {Gas{job.d, job.n, job.particles, number(job.kind), job.e.value_or(any_e)},
                         Gas{job.d, job.n, job.particles, number(job.kind), any_e},
                         Gas{job.d, job.n, job.particles, any_kind, any_e}}) {
    const auto found = known_.find(gas);
    if (found == known_.end() || found->second.cpu_seconds < trustworthy) continue;
    used_store_ = true;
    return found->second.collisions / found->second.cpu_seconds;
  }
  return trial_speed(job);
}

double Forecast::trial_speed(const schema::Job& job) {
  const Gas gas{job.d, job.n, job.particles, any_kind, any_e};
  const auto found = trial_speeds_.find(gas);
  if (found != trial_speeds_.end()) return found->second;
  const double seconds =
      trial_speeds_.size() < trials_at_length ? trial_seconds : 0.1 * trial_seconds;
  return trial_speeds_[gas] = calibrate(job.d, job.n, job.particles, seconds).collisions_per_second;
}

double Forecast::cpu_seconds(const schema::Planned& plan) {
  return 0.5 * plan.tau_max * plan.job.particles / collisions_per_second(plan.job);
}

double Forecast::memory_bytes(const schema::Job& job) {
  const auto [place, is_new] = bytes_per_particle_.try_emplace({job.d, job.n}, 0);
  if (is_new) place->second = calibrate(job.d, job.n, small_gas, 0).bytes_per_particle;
  return program_bytes + (place->second + 2 * state_bytes) * job.particles;
}

double Forecast::disk_bytes(const schema::Planned& plan) const {
  const double interval = plan.job.sample_every;
  return job_bytes + state_bytes * plan.job.particles +
         sample_bytes * static_cast<double>(sample_count(interval, plan.tau_max));
}

std::string Forecast::source() const {
  return used_store_ ? "speeds as in this store" : "speeds from a short trial";
}

}  // namespace haff::campaign
