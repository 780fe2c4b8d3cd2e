#include "campaign/job/measurement.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "analysis/observables/coarse_grained.hpp"
#include "analysis/observables/distribution.hpp"
#include "analysis/observables/equilibrium.hpp"
#include "analysis/observables/moments.hpp"
#include "analysis/observables/species.hpp"
#include "analysis/observables/structure.hpp"
#include "analysis/observables/velocity_correlations.hpp"
#include "analysis/theory/cooling.hpp"
#include "analysis/theory/correlations.hpp"
#include "campaign/job/timetable.hpp"
#include "campaign/state/model.hpp"
#include "engine/initial.hpp"

namespace haff::campaign {
namespace {

bool asks_for(const schema::Job& job, std::string_view observable) {
  return std::find(job.observables.begin(), job.observables.end(), observable) !=
         job.observables.end();
}

std::optional<double> if_finite(double value) {
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

// Mean over the time since the last of the earlier rows, which has a temperature.
double mean_temperature(std::span<const schema::Sample> earlier, const schema::Sample& now) {
  constexpr std::size_t useful = 3;  // beside this row: analysis::mean_temperature uses four
  std::vector<double> time, temperature;
  for (const schema::Sample& row : earlier.last(std::min(useful, earlier.size()))) {
    if (!row.temperature) continue;
    time.push_back(row.time);
    temperature.push_back(*row.temperature);
  }
  time.push_back(now.time);
  temperature.push_back(*now.temperature);
  return analysis::mean_temperature(time, temperature);
}

void measure_temperature(schema::Sample& sample, double temperature, double virial,
                         double collisions, const schema::Job& job,
                         std::span<const schema::Sample> earlier) {
  sample.temperature = temperature;
  if (earlier.empty() || !earlier.back().temperature) return;
  const schema::Sample& previous = earlier.back();
  const double elapsed = sample.time - previous.time;
  if (cools_by_haff(job))
    sample.gamma_ratio = if_finite(analysis::gamma_ratio(*previous.temperature, temperature,
                                                         sample.tau - previous.tau, *job.e, job.d));
  sample.collision_rate = if_finite(analysis::collision_rate(collisions, job.particles, elapsed));
  sample.pressure = if_finite(analysis::pressure(job.n, mean_temperature(earlier, sample), virial,
                                                 job.particles, elapsed, job.d));
}

// Velocities v of a simple gas, sqrt(m) v of a mixture, whose temperature and moments are then
// those of all particles alike, and Gaussian in equilibrium.
std::vector<engine::Vector> weighted_velocities(const engine::Simulation& gas,
                                                const std::optional<engine::Mixture>& mixture) {
  auto velocities = gas.velocities();
  if (!mixture) return velocities;
  const auto ids = gas.ids();
  for (std::size_t i = 0; i < ids.size(); ++i)
    for (double& v : velocities[i]) v *= std::sqrt(mixture->mass_of(ids[i]));
  return velocities;
}

void measure_species(schema::Sample& sample, const engine::Simulation& gas,
                     const engine::Mixture& mixture, const schema::Job& job) {
  std::vector<bool> is_second;
  for (const std::uint32_t id : gas.ids()) is_second.push_back(mixture.is_second(id));
  const auto temperature =
      analysis::species_temperatures(gas.velocities(), is_second, {1, mixture.mass}, job.d);
  sample.temperature_1 = std::ldexp(temperature[0], -2 * gas.exponent());
  sample.temperature_2 = std::ldexp(temperature[1], -2 * gas.exponent());
}

void measure_laguerre(schema::Sample& sample, const analysis::LaguerreCoefficients& a) {
  sample.a2 = if_finite(a[2]);
  sample.a3 = if_finite(a[3]);
  sample.a4 = if_finite(a[4]);
  sample.a5 = if_finite(a[5]);
  sample.a6 = if_finite(a[6]);
}

// A gas at one moment. Velocities are scaled by 2^exponent: `power` 1 turns a velocity, 2 an
// energy into true units, exactly.
struct Snapshot {
  Snapshot(const engine::Simulation& gas, const schema::Job& job)
      : position(gas.positions()),
        velocity(gas.velocities()),
        exponent(gas.exponent()),
        box(engine::box_side(job.n, job.particles, job.d)) {}

  std::vector<double> unscaled(std::vector<double> values, int power) const {
    for (double& value : values) value = std::ldexp(value, -power * exponent);
    return values;
  }

  std::vector<engine::Vector> position, velocity;
  int exponent;
  double box;
};

void view_correlations(const Snapshot& gas, const schema::Job& job, schema::Sample& sample,
                       Views& views) {
  const double k_max = analysis::cutoff_wavenumber(job.n, analysis::cutoff_b, job.d);
  const auto g = analysis::velocity_correlations(gas.position, gas.velocity, gas.box, k_max, job.d);
  views.profiles.push_back({"G_parallel", sample.tau, g.r, gas.unscaled(g.parallel, 2)});
  views.profiles.push_back({"G_perpendicular", sample.tau, g.r, gas.unscaled(g.perpendicular, 2)});
  sample.correlation_trace = std::ldexp(g.trace, -2 * gas.exponent);
}

void view_profiles(const Snapshot& gas, const schema::Job& job, schema::Sample& sample,
                   Views& views) {
  if (asks_for(job, "distribution")) {
    auto speeds = analysis::speed_distribution(gas.velocity, job.d);
    views.profiles.push_back({"rho", sample.tau, std::move(speeds.c), std::move(speeds.rho)});
  }
  if (asks_for(job, "correlations")) view_correlations(gas, job, sample, views);
  if (asks_for(job, "structure")) {
    auto structure = analysis::structure_factor(gas.position, gas.box, job.d);
    views.profiles.push_back({"S", sample.tau, std::move(structure.k), std::move(structure.value)});
  }
  if (asks_for(job, "clusters"))
    sample.largest_cluster = analysis::largest_cluster(gas.position, gas.box, job.d);
}

void view_fields(const Snapshot& gas, const schema::Job& job, double tau, Views& views) {
  const int cells = analysis::coarse_cells(job.particles, job.d);
  const auto fluid = analysis::coarse_grained(gas.position, gas.velocity, gas.box, cells, job.d);
  views.fields.push_back({"density", tau, cells, 1, gas.box, fluid.density});
  views.fields.push_back({"velocity", tau, cells, job.d, gas.box, gas.unscaled(fluid.velocity, 1)});
  views.fields.push_back(
      {"temperature", tau, cells, 1, gas.box, gas.unscaled(fluid.temperature, 2)});
}

}  // namespace

schema::Sample measure(engine::Simulation& gas, const schema::Job& job, double tau,
                       std::span<const schema::Sample> earlier) {
  schema::Sample sample;
  sample.tau = tau;
  sample.time = gas.time();

  const engine::Tally tally = gas.take_tally();
  if (!asks_for(job, "temperature") && !asks_for(job, "laguerre")) return sample;

  const auto mixture = mixture_of(job);
  const analysis::Moments moments = analysis::moments(weighted_velocities(gas, mixture), job.d);
  if (asks_for(job, "temperature")) {
    const double temperature = std::ldexp(moments.temperature, -2 * gas.exponent());
    const std::int64_t collisions =
        earlier.empty()
            ? 0
            : gas.collisions() - engine::collisions_at(earlier.back().tau, job.particles);
    measure_temperature(sample, temperature, tally.virial, static_cast<double>(collisions), job,
                        earlier);
    if (const auto energy = gas.rotational_energy())
      sample.rotational_temperature =
          std::ldexp(*energy * 2 / axes_of_rotation(job.d), -2 * gas.exponent());
    if (mixture) measure_species(sample, gas, *mixture, job);
  }
  if (asks_for(job, "laguerre")) measure_laguerre(sample, moments.laguerre);
  return sample;
}

Views view(const engine::Simulation& gas, const schema::Job& job, schema::Sample& sample) {
  Views views;
  const bool profiles = has_profiles(job, sample.tau), fields = has_fields(job, sample.tau);
  if (!profiles && !fields) return views;
  const Snapshot snapshot(gas, job);
  if (profiles) view_profiles(snapshot, job, sample, views);
  if (fields) view_fields(snapshot, job, sample.tau, views);
  return views;
}

schema::Results results(const std::vector<schema::Sample>& samples, const schema::Job& job) {
  if (!cools_by_haff(job)) return {};
  std::vector<double> tau;
  std::vector<double> temperature;
  for (const schema::Sample& sample : samples) {
    if (!sample.temperature) return {};
    tau.push_back(sample.tau);
    temperature.push_back(*sample.temperature);
  }
  const auto tau_c = analysis::tau_c(tau, temperature, *job.e, job.d);
  if (!tau_c) return {};

  const auto after = std::lower_bound(
      samples.begin(), samples.end(), *tau_c,
      [](const schema::Sample& sample, double wanted) { return sample.tau < wanted; });
  if (after == samples.begin() || after == samples.end()) return {tau_c, std::nullopt};
  const schema::Sample& left = *(after - 1);
  const double part = (*tau_c - left.tau) / (after->tau - left.tau);
  return {tau_c, left.time + part * (after->time - left.time)};
}

bool is_equilibrated(const schema::Sample& sample, const schema::Job& job) {
  return analysis::is_equilibrated({sample.a2, sample.a3, sample.a4}, job.particles, job.d);
}

}  // namespace haff::campaign
