// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/planning/forecast.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "analysis/observables/coarse_grained.hpp"
#include "analysis/observables/pair_distribution.hpp"
#include "analysis/observables/tail.hpp"
#include "analysis/theory/cooling.hpp"
#include "campaign/job/expected_rate.hpp"
#include "campaign/job/timetable.hpp"
#include "campaign/state/model.hpp"
#include "engine/initial.hpp"
#include "engine/simulation.hpp"
#include "schema/grid/observables.hpp"

namespace haff::campaign {
namespace {

// A speed in the store from less CPU time than this is less exact than a trial. [s]
constexpr double trustworthy = 0.2;

// The length of a trial; in a plan of many gases, trials after the first ten take a tenth of it.
// [s]
constexpr double trial_seconds = 0.25;
constexpr std::size_t trials_at_length = 10;

// What storing a state takes beside the gas: the state, the same encoded, and a chunk of it in
// SQLite. [bytes per particle]
constexpr double storing_bytes = 226;

// What a worker holds beyond that, as measured: the program, and holes in the heap, which grow with
// the gas until its arrays are so large that they are not a part of the heap. [bytes]
constexpr double program_bytes = 17e6;
constexpr double holes_per_particle = 100, most_holes = 15e6;
constexpr double transform_bytes = 2.5e6;  // FFTW and its plans, where something takes them

// One row of samples (12 numbers) and of jobs in SQLite, with their share of the index pages.
constexpr double sample_bytes = 115;
constexpr double job_bytes = 1000;

// Jobs with equal keys are equally fast: the key names all that is computed and measured between
// two collisions. How the jobs began, and from which seed, does not matter.
std::string alike(schema::Job job) {
  job.equilibrate = 0;
  return schema::series_identity(job);
}

// The same for any e, which matters less. It is used where no job of the same e has run, and in
// trials, which are over before cooling changes the gas.
std::string alike_but_for_e(schema::Job job) {
  job.e = std::nullopt;
  return alike(std::move(job));
}

// An equilibration ends where it can be stored.
double end_of(const schema::Planned& plan) {
  if (plan.job.kind == schema::Kind::cooling) return plan.tau_max;
  if (plan.job.equilibrate == 0) return 0;
  return synchronization_tau(synchronization_at_or_after(plan.tau_max));
}

// How often a job does what, as its timetable says (campaign/job/timetable.hpp), without walking
// through it: a run may have millions of stops.
struct Counts {
  double samples = 0, profiles = 0, fields = 0, snapshots = 0, synchronizations = 0, commits = 0;
  double at_times = 0;  // samples at moments of time
};

// When a gas that cools by Haff's law, or does not cool, reaches tau: only how many moments in time
// come before that hangs on it.
double expected_time(const schema::Job& job, double tau) {
  const double rate = expected_collision_rate(job, analysis::initial_temperature(job.d));
  const double decay = cools_by_haff(job) ? (1 - *job.e * *job.e) / (2.0 * job.d) : 0;
  return decay > 0 ? std::expm1(decay * tau) / (decay * rate) : tau / rate;
}

Counts counts_of(const schema::Planned& plan) {
  const double end = end_of(plan);
  Counts counts;
  counts.samples = static_cast<double>(sample_count(plan.job, end));
  if (plan.job.profiles_every)
    counts.profiles = static_cast<double>(sample_count(*plan.job.profiles_every, end));
  counts.fields = static_cast<double>(
      std::ranges::count_if(plan.job.fields_at, [&](double tau) { return tau <= end; }));
  const double last_time = expected_time(plan.job, end);
  counts.at_times = static_cast<double>(count_through(plan.job.sample_at.time, last_time));
  counts.snapshots = static_cast<double>(count_through(plan.job.snapshots_at.tau, end) +
                                         count_through(plan.job.snapshots_at.time, last_time));
  counts.synchronizations = std::floor(end / engine::synchronization_period);
  counts.commits = std::min(counts.synchronizations,
                            std::floor(end / plan.checkpoint_every) + 1);  // the last one too
  return counts;
}

double sum_of(const Prices& prices, const schema::Planned& plan) {
  const Counts counts = counts_of(plan);
  return prices.start + 0.5 * end_of(plan) * plan.job.particles * prices.collision +
         (counts.samples + counts.at_times) * prices.sample + counts.profiles * prices.profiles +
         counts.fields * prices.fields + counts.synchronizations * prices.synchronization +
         (counts.commits + counts.snapshots) * prices.commit;
}

// Points of all the curves that are taken at once, and bytes of a point (a row with a name, three
// numbers and the job). The curves have as many points as their meshes have shells (analysis/
// observables).
constexpr double profile_row_bytes = 46;

double mesh_cells(double box) {
  constexpr double most = 128;
  return std::min(most, std::floor(box));
}

double profile_points(const schema::Job& job, double box) {
  double points = 0;
  for (const std::string& observable : job.observables) {
    if (observable == "distribution") points += 40;  // bins of 0.1 up to some four thermal speeds
    if (observable == "correlations") points += 2 * std::floor(mesh_cells(box) / 2);
    if (observable == "structure")
      points += std::floor(mesh_cells(box) / 4) * (job.effects.contains("mixture") ? 4 : 1);
    if (observable == "energy_spectrum") points += 3 * std::floor(mesh_cells(box) / 4);
    if (observable == "pair_distribution")
      points += (std::min(analysis::pair_reach, box / 2) - 1) / analysis::pair_bin *
                (job.effects.contains("mixture") ? 3 : 1);
    if (observable == "tail") points += analysis::tail_bins;
    if (observable == "collision_statistics")
      points += engine::CollisionCounts::bins_of_free_time +
                engine::CollisionCounts::bins_of_impact +
                engine::CollisionCounts::bins_of_normal_speed;
    if (observable == "cluster_sizes") points += std::log2(job.particles) + 2;
  }
  return points;
}

// tau, temperature and five coefficients of a sample at a moment of time.
constexpr double points_at_time = 7;

// Of each sample, msd with diffusion, and vacf.
double diffusion_points(const schema::Job& job) {
  double points = 0;
  for (const std::string& observable : job.observables)
    if (schema::waiting_time(observable)) points += observable.starts_with("msd") ? 2 : 1;
  return points;
}

// In the state: image numbers, and positions and velocities of every waiting time; the last
// collision of every particle.
double remembered_bytes(const schema::Job& job) {
  std::set<double> waiting;
  for (const std::string& observable : job.observables)
    if (const auto time = schema::waiting_time(observable)) waiting.insert(*time);
  const double diffusion = waiting.empty() ? 0 : 24 + 48.0 * static_cast<double>(waiting.size());
  const double collision = model_of(job).counts_collisions ? sizeof(double) : 0;
  return (diffusion + collision) * job.particles;
}

double field_bytes(const schema::Job& job) {
  const double cells = analysis::coarse_cells(job.particles, job.d);
  return std::pow(cells, job.d) * (job.d + 2) * sizeof(double);
}

double box_of(const schema::Job& job) {
  return engine::box_side(job.n, job.particles, job.d);
}

// Arrays that a look at the whole gas needs at once: for correlations a field and its transform,
// the transforms of number and momenta, and weights; for a structure factor a field and its
// transform. With them positions and velocities.
double view_bytes(const schema::Job& job) {
  if (!job.profiles_every && job.fields_at.empty()) return 0;
  const double cells = std::pow(mesh_cells(box_of(job)), job.d) * sizeof(double);
  double arrays = 0;
  for (const std::string& observable : job.observables) {
    if (observable == "correlations") arrays = std::max(arrays, (job.d + 4.0) * cells);
    if (observable == "structure") arrays = std::max(arrays, 2 * cells);
    if (observable == "energy_spectrum") arrays = std::max(arrays, (job.d + 2.0) * cells);
    if (schema::is_field(observable)) arrays = std::max(arrays, 2 * field_bytes(job));
  }
  return arrays + 52.0 * job.particles;
}

double bytes_of_transforms(const schema::Job& job) {
  const auto takes = [](const std::string& observable) {
    return observable == "correlations" || observable == "structure" ||
           observable == "energy_spectrum";
  };
  return std::ranges::any_of(job.observables, takes) ? transform_bytes : 0;
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

// Snapshots wait for the next synchronization, some of them: a job does not let them become many.
double Forecast::waiting_snapshots_bytes(const schema::Job& job) {
  if (job.snapshots_at.empty()) return 0;
  constexpr double period = engine::synchronization_period;
  const double count =
      static_cast<double>(count_through(job.snapshots_at.tau, period) +
                          count_through(job.snapshots_at.time, expected_time(job, period)));
  const double each = sizes_of(job).state * job.particles;
  return std::min(count * each, static_cast<double>(most_waiting_snapshots) + each);
}

double Forecast::memory_bytes(const schema::Job& job) {
  return program_bytes + std::min(holes_per_particle * job.particles, most_holes) +
         sizes_of(job).engine * job.particles +
         std::max(storing_bytes * job.particles, view_bytes(job)) + 3 * remembered_bytes(job) +
         waiting_snapshots_bytes(job) + bytes_of_transforms(job);
}

const Sizes& Forecast::sizes_of(const schema::Job& job) {
  const auto [place, is_new] = sizes_.try_emplace({job.d, job.n, job.effects});
  if (is_new) place->second = sizes(job);
  return place->second;
}

double Forecast::disk_bytes(const schema::Planned& plan) {
  const Counts counts = counts_of(plan);
  // What others start from is stored even where nothing was equilibrated.
  const bool has_state = counts.commits > 0 || plan.job.kind == schema::Kind::equilibration;
  const double state = has_state ? sizes_of(plan.job).state : 0;
  // A snapshot has no invariants and no memory, and is otherwise a state.
  const double kept = counts.snapshots > 0 ? sizes_of(plan.job).state * plan.job.particles : 0;
  return job_bytes + counts.snapshots * kept +
         counts.at_times * profile_row_bytes * points_at_time + state * plan.job.particles +
         (state > 0 ? remembered_bytes(plan.job) : 0) + sample_bytes * counts.samples +
         counts.profiles * profile_row_bytes * profile_points(plan.job, box_of(plan.job)) +
         counts.samples * profile_row_bytes * diffusion_points(plan.job) +
         counts.fields * field_bytes(plan.job);
}

std::string Forecast::source() const {
  return used_store_ ? "speeds as in this store" : "speeds from a short trial";
}

}  // namespace haff::campaign
