// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/grid/observables.hpp"

#include <algorithm>
#include <array>
#include <charconv>

namespace haff::schema {
namespace {

// The measurements refuse boxes in which they would find fewer than two shells, or a particle
// twice.
constexpr std::array all_observables{
    Observable{"temperature"},
    Observable{"laguerre"},
    Observable{"distribution", Taken::with_profiles},
    Observable{"tail", Taken::with_profiles},
    Observable{"correlations", Taken::with_profiles, 4},
    Observable{"structure", Taken::with_profiles, 8},
    Observable{"pair_distribution", Taken::with_profiles, 4},
    Observable{"energy_spectrum", Taken::with_profiles, 8},
    Observable{"clusters", Taken::with_profiles},
    Observable{"cluster_sizes", Taken::with_profiles, 2.2},
    Observable{"collision_statistics", Taken::with_profiles},
    Observable{"msd", Taken::with_samples},
    Observable{"vacf", Taken::with_samples},
    Observable{"fields", Taken::with_fields},
};

constexpr std::array all_curves{
    Curve{"tau_at_time", "temperature", "t", "collisions per particle until t (sample_at)"},
    Curve{"temperature_at_time", "temperature", "t", "temperature at t [E(0)]"},
    Curve{"a2_at_time", "laguerre", "t", "a2 at t"},
    Curve{"a3_at_time", "laguerre", "t", "a3 at t"},
    Curve{"a4_at_time", "laguerre", "t", "a4 at t"},
    Curve{"a5_at_time", "laguerre", "t", "a5 at t"},
    Curve{"a6_at_time", "laguerre", "t", "a6 at t"},
    Curve{"rotational_temperature_at_time", "temperature", "t", "of rotation at t (roughness)"},
    Curve{"temperature_1_at_time", "temperature", "t", "of species 1 at t (mixture)"},
    Curve{"temperature_2_at_time", "temperature", "t", "of species 2 at t"},
    Curve{"rho", "distribution", "c", "velocity distribution, a Gaussian gas has exp(-c^2)"},
    Curve{"tail", "tail", "c", "the same beyond c = 3, in bins of equal ratio"},
    Curve{"tail_exponent", "tail", "c", "alpha of exp(-A c^alpha) beyond this c"},
    Curve{"G_parallel", "correlations", "r", "velocity correlation along r, no self part [E(0)/m]"},
    Curve{"G_perpendicular", "correlations", "r", "likewise across r"},
    Curve{"S", "structure", "k", "static structure factor"},
    Curve{"S_11", "structure", "k", "partial, |sum over species 1|^2 / N (mixture)"},
    Curve{"S_12", "structure", "k", "partial, of species 1 with species 2"},
    Curve{"S_22", "structure", "k", "partial, of species 2"},
    Curve{"g", "pair_distribution", "r", "pair distribution, its first point is at contact"},
    Curve{"g_11", "pair_distribution", "r", "of species 1 (mixture)"},
    Curve{"g_12", "pair_distribution", "r", "of species 1 with species 2"},
    Curve{"g_22", "pair_distribution", "r", "of species 2"},
    Curve{"E_perpendicular", "energy_spectrum", "k", "energy of transverse modes [E(0) sigma]"},
    Curve{"E_parallel", "energy_spectrum", "k", "energy of longitudinal modes [E(0) sigma]"},
    Curve{"enstrophy", "energy_spectrum", "k", "k^2 E_perpendicular, of vorticity [E(0)/sigma]"},
    Curve{"cluster_sizes", "cluster_sizes", "s", "share of particles in clusters of s to 2s-1"},
    Curve{"mean_cluster", "cluster_sizes", "s", "mean size of a particle's cluster, at s = 1"},
    Curve{"free_times", "collision_statistics", "u",
          "density of free times, u = omega t, since the profiles before"},
    Curve{"impacts", "collision_statistics", "b",
          "density of impact parameters b^(d-1), likewise: 1 in molecular chaos"},
    Curve{"normal_speeds", "collision_statistics", "w",
          "density of speeds of approach over sqrt(T/mu), likewise"},
    Curve{"msd", "msd", "lag",
          "mean square displacement since tau, lag collisions later [sigma^2]"},
    Curve{"diffusion", "msd", "lag", "slope of msd over 2d, D/omega [sigma^2]"},
    Curve{"vacf", "vacf", "lag", "correlation of velocities with those at tau"},
};

template <class Table>
auto find(const Table& table, std::string_view name) {
  const auto found =
      std::find_if(table.begin(), table.end(), [&](const auto& each) { return each.name == name; });
  return found == table.end() ? nullptr : &*found;
}

std::string_view before_at(std::string_view observable) {
  return observable.substr(0, observable.find('@'));
}

}  // namespace

std::span<const Observable> observables() {
  return all_observables;
}

const Observable* find_observable(std::string_view name) {
  return find(all_observables, before_at(name));
}

std::optional<double> waiting_time(std::string_view observable) {
  const std::string_view name = before_at(observable);
  if (name != "msd" && name != "vacf") return std::nullopt;
  double tau = 0;
  if (name.size() < observable.size())
    std::from_chars(observable.data() + name.size() + 1, observable.data() + observable.size(),
                    tau);
  return tau;
}

std::span<const Curve> curves() {
  return all_curves;
}

const Curve* find_curve(std::string_view name) {
  return find(all_curves, name);
}

}  // namespace haff::schema
