#include "campaign/planning/forecast.hpp"

#include <utility>

#include "campaign/job/timetable.hpp"

namespace haff::campaign {
namespace {

// CPU time below which a speed in the store says less than a trial would. [s]
constexpr double trustworthy = 0.2;

// A trial takes so long; in a plan of many gases those after the first ten take a tenth. [s]
constexpr double trial_seconds = 0.25;
constexpr std::size_t trials_at_length = 10;

// A particle in engine::State, which a worker that stores it holds once, and once more encoded.
constexpr double state_bytes = 52;

// A worker with no gas. [bytes]
constexpr double program_bytes = 12e6;

// One row of samples (12 numbers) and of jobs in SQLite, with their share of the index pages.
constexpr double sample_bytes = 115;
constexpr double job_bytes = 1000;

// Jobs of which this is equal are as fast as each other: it names all that is computed and measured
// between two collisions. How they began, and from which seed, does not matter.
std::string alike(schema::Job job) {
  job.equilibrate = 0;
  return schema::series_identity(job);
}

// The same for any e, which matters less: where no job of the same e has run, and in trials, which
// are over before a gas that cools has become another than one that does not.
std::string alike_but_for_e(schema::Job job) {
  job.e = std::nullopt;
  return alike(std::move(job));
}

// An equilibration ends where it can be stored.
double end_of(const schema::Planned& plan) {
  if (plan.job.kind == schema::Kind::cooling) return plan.tau_max;
  return synchronization_tau(synchronization_at_or_after(plan.tau_max));
}

double sum_of(const Prices& prices, const schema::Planned& plan) {
  const double end = end_of(plan);
  double sum = prices.start + 0.5 * end * plan.job.particles * prices.collision;
  Timetable timetable(plan.job, end, plan.checkpoint_every);
  while (const auto stop = timetable.next()) {
    if (stop->due == Stop::Due::synchronization) {
      sum += prices.synchronization + (stop->keep ? prices.commit : 0);
      continue;
    }
    sum += prices.sample;
    if (has_profiles(plan.job, stop->tau)) sum += prices.profiles;
    if (has_fields(plan.job, stop->tau)) sum += prices.fields;
  }
  return sum;
}

}  // namespace

Forecast::Forecast(const std::vector<schema::JobRow>& known) {
  for (const schema::JobRow& row : known)
    for (const std::string& which : {alike(row.job), alike_but_for_e(row.job)}) {
      Work& work = known_[which];
      work.collisions += static_cast<double>(row.progress.collisions);
      work.cpu_seconds += row.progress.cpu_seconds;
    }
}

std::optional<double> Forecast::known_seconds_per_collision(const schema::Job& job) {
  for (const std::string& which : {alike(job), alike_but_for_e(job)}) {
    const auto found = known_.find(which);
    if (found == known_.end() || found->second.cpu_seconds < trustworthy ||
        found->second.collisions == 0)  // it has only begun
      continue;
    used_store_ = true;
    return found->second.cpu_seconds / found->second.collisions;
  }
  return std::nullopt;
}

const Prices& Forecast::prices(const schema::Planned& plan) {
  const double seconds = tried_.size() < trials_at_length ? trial_seconds : 0.1 * trial_seconds;
  const auto [place, is_new] = tried_.try_emplace(alike_but_for_e(plan.job));
  if (is_new) place->second = try_out(plan.job, end_of(plan), seconds);
  return place->second;
}

double Forecast::cpu_seconds(const schema::Planned& plan) {
  if (const auto known = known_seconds_per_collision(plan.job))
    return 0.5 * end_of(plan) * plan.job.particles * *known;
  return sum_of(prices(plan), plan);
}

double Forecast::memory_bytes(const schema::Job& job) {
  const auto [place, is_new] = bytes_per_particle_.try_emplace({job.d, job.n, job.effects}, 0);
  if (is_new) place->second = bytes_per_particle(job);
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
