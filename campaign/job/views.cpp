// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/job/views.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "analysis/observables/cluster_sizes.hpp"
#include "analysis/observables/coarse_grained.hpp"
#include "analysis/observables/distribution.hpp"
#include "analysis/observables/energy_spectrum.hpp"
#include "analysis/observables/pair_distribution.hpp"
#include "analysis/observables/structure.hpp"
#include "analysis/observables/tail.hpp"
#include "analysis/observables/velocity_correlations.hpp"
#include "analysis/theory/correlations.hpp"
#include "campaign/job/asked.hpp"
#include "campaign/job/timetable.hpp"
#include "campaign/state/model.hpp"
#include "engine/initial.hpp"

namespace haff::campaign {
namespace {

using Values = std::vector<double>;

// A gas at one moment. Velocities are scaled by 2^exponent. `power` 1 brings a velocity, 2 an
// energy into true units, exactly.
struct Snapshot {
  Snapshot(const engine::Simulation& gas, const schema::Job& its_job)
      : job(its_job),
        position(gas.positions()),
        velocity(gas.velocities()),
        id(gas.ids()),
        exponent(gas.exponent()),
        box(engine::box_side(job.n, job.particles, job.d)),
        mixture(mixture_of(job)),
        weighted(weighted_velocities(gas, mixture)) {
    if (!mixture) return;
    mass.reserve(id.size());
    for (const std::uint32_t each : id) mass.push_back(mixture->mass_of(each));
  }

  Values unscaled(Values values, int power) const {
    for (double& value : values) value = std::ldexp(value, -power * exponent);
    return values;
  }
  // Of one species of a mixture.
  std::vector<engine::Vector> positions(bool of_second) const {
    std::vector<engine::Vector> chosen;
    for (std::size_t i = 0; i < id.size(); ++i)
      if (mixture->is_second(id[i]) == of_second) chosen.push_back(position[i]);
    return chosen;
  }

  const schema::Job& job;
  std::vector<engine::Vector> position, velocity;
  std::vector<std::uint32_t> id;
  int exponent;
  double box;
  std::optional<engine::Mixture> mixture;
  std::vector<engine::Vector> weighted;  // sqrt(m) v
  Values mass;                           // empty if all are 1
};

// Where measurements go: the sample that they belong to, and the curves beside it.
struct Page {
  schema::Sample& sample;
  Views& views;

  void add(std::string name, Values x, Values value) const {
    views.profiles.push_back({std::move(name), sample.tau, std::move(x), std::move(value)});
  }
};

void view_distribution(const Snapshot& gas, const Page& page) {
  auto speeds = analysis::speed_distribution(gas.weighted, gas.job.d);
  page.add("rho", std::move(speeds.c), std::move(speeds.rho));
}

void view_tail(const Snapshot& gas, const Page& page) {
  auto tail = analysis::tail(gas.weighted, gas.job.d);
  page.add("tail", std::move(tail.c), std::move(tail.rho));
  if (tail.exponent) page.add("tail_exponent", {analysis::tail_begin}, {*tail.exponent});
}

void view_correlations(const Snapshot& gas, const Page& page) {
  const double k_max = analysis::cutoff_wavenumber(gas.job.n, analysis::cutoff_b, gas.job.d);
  const auto g =
      analysis::velocity_correlations(gas.position, gas.velocity, gas.box, k_max, gas.job.d);
  page.add("G_parallel", g.r, gas.unscaled(g.parallel, 2));
  page.add("G_perpendicular", g.r, gas.unscaled(g.perpendicular, 2));
  page.sample.correlation_trace = std::ldexp(g.trace, -2 * gas.exponent);
}

void view_structure(const Snapshot& gas, const Page& page) {
  const auto all = analysis::structure_factor(gas.position, gas.box, gas.job.d);
  page.add("S", all.k, all.value);
  if (!gas.mixture) return;
  const auto particles = static_cast<double>(gas.id.size());
  const auto partial = [&](bool of_second) {
    const auto position = gas.positions(of_second);
    Values value = analysis::structure_factor(position, gas.box, gas.job.d).value;
    for (double& each : value) each *= static_cast<double>(position.size()) / particles;
    return value;
  };
  Values first = partial(false), second = partial(true), cross;
  for (std::size_t s = 0; s < all.k.size(); ++s)
    cross.push_back((all.value[s] - first[s] - second[s]) / 2);
  page.add("S_11", all.k, std::move(first));
  page.add("S_12", all.k, std::move(cross));
  page.add("S_22", all.k, std::move(second));
}

void view_pair_distribution(const Snapshot& gas, const Page& page) {
  const auto add = [&](std::string name, analysis::PairDistribution pairs) {
    page.add(std::move(name), std::move(pairs.r), std::move(pairs.g));
  };
  const int d = gas.job.d;
  if (!gas.mixture) return add("g", analysis::pair_distribution(gas.position, gas.box, d));
  const auto first = gas.positions(false), second = gas.positions(true);
  const double small = gas.mixture->diameter;
  if (first.size() > 1) add("g_11", analysis::pair_distribution(first, gas.box, d, 1));
  add("g_12", analysis::pair_distribution(first, second, gas.box, (1 + small) / 2, d));
  if (second.size() > 1) add("g_22", analysis::pair_distribution(second, gas.box, d, small));
}

void view_energy_spectrum(const Snapshot& gas, const Page& page) {
  auto spectrum =
      analysis::energy_spectrum(gas.position, gas.velocity, gas.mass, gas.box, gas.job.d);
  page.add("E_perpendicular", spectrum.k, gas.unscaled(std::move(spectrum.transverse), 2));
  page.add("E_parallel", spectrum.k, gas.unscaled(std::move(spectrum.longitudinal), 2));
  page.add("enstrophy", spectrum.k, gas.unscaled(std::move(spectrum.enstrophy), 2));
}

void view_clusters(const Snapshot& gas, const Page& page) {
  page.sample.largest_cluster = analysis::largest_cluster(gas.position, gas.box, gas.job.d);
}

void view_cluster_sizes(const Snapshot& gas, const Page& page) {
  const auto contact = [&](std::size_t i, std::size_t j) {
    return gas.mixture->contact_distance(gas.id[i], gas.id[j]);
  };
  auto clusters = gas.mixture ? analysis::cluster_sizes(gas.position, gas.box, gas.job.d, contact)
                              : analysis::cluster_sizes(gas.position, gas.box, gas.job.d);
  page.add("cluster_sizes", std::move(clusters.size), std::move(clusters.share));
  page.add("mean_cluster", {1}, {clusters.mean});
}

struct View {
  std::string_view observable;
  void (*take)(const Snapshot& gas, const Page& page);
};
constexpr std::array with_profiles{
    View{"distribution", view_distribution},
    View{"tail", view_tail},
    View{"correlations", view_correlations},
    View{"structure", view_structure},
    View{"pair_distribution", view_pair_distribution},
    View{"energy_spectrum", view_energy_spectrum},
    View{"clusters", view_clusters},
    View{"cluster_sizes", view_cluster_sizes},
};

void view_fields(const Snapshot& gas, double tau, Views& views) {
  const int d = gas.job.d;
  const int cells = analysis::coarse_cells(gas.job.particles, d);
  const auto fluid =
      analysis::coarse_grained(gas.position, gas.velocity, gas.box, cells, d, gas.mass);
  views.fields.push_back({"density", tau, cells, 1, gas.box, fluid.density});
  views.fields.push_back({"velocity", tau, cells, d, gas.box, gas.unscaled(fluid.velocity, 1)});
  views.fields.push_back(
      {"temperature", tau, cells, 1, gas.box, gas.unscaled(fluid.temperature, 2)});
}

}  // namespace

Views view(const engine::Simulation& gas, const schema::Job& job, schema::Sample& sample) {
  Views views;
  const bool profiles = has_profiles(job, sample.tau), fields = has_fields(job, sample.tau);
  if (!profiles && !fields) return views;
  const Snapshot snapshot(gas, job);
  if (profiles)
    for (const View& each : with_profiles)
      if (asks_for(job, each.observable)) each.take(snapshot, {sample, views});
  if (fields) view_fields(snapshot, sample.tau, views);
  return views;
}

}  // namespace haff::campaign
