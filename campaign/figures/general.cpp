// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/figures/general.hpp"

#include <vector>

namespace haff::campaign {
namespace {

// With so many gases theory is still told apart.
constexpr std::size_t most_with_theory = 6;

// Of each run its last profile.
constexpr const char* at_the_end = "tau + profiles_every > tau_max * (1 + 1e-9)";

Question along_tau(const char* y) {
  return {.y = y, .theory = true, .theory_up_to = most_with_theory};
}

Question logarithmic(Question question) {
  question.log_y = true;
  return question;
}

Question doubly_logarithmic(Question question) {
  question.log_x = question.log_y = true;
  return question;
}

Question profile(const char* y) {
  return {.y = y, .where = at_the_end, .theory = true, .theory_up_to = most_with_theory};
}

const std::vector<GeneralFigure> all_figures = {
    {"energy", "energy of translation", logarithmic(along_tau("energy"))},
    {"gamma", "decay rate", along_tau("gamma_ratio")},
    {"a2", "Laguerre coefficient a₂", along_tau("a2")},
    {"a3", "Laguerre coefficient a₃", along_tau("a3")},
    {"a4", "Laguerre coefficient a₄", along_tau("a4")},
    {"pressure", "pressure against the equation of state", along_tau("Z")},
    {"collision-rate", "collision rate", logarithmic(along_tau("collision_rate"))},
    {"tau-c",
     "end of the homogeneous stage",
     {.y = "tau_c", .against = "e", .theory = true, .theory_up_to = most_with_theory}},
    {"rotation", "temperature of rotation over that of translation", along_tau("rotational_ratio")},
    {"species", "temperatures of the species", along_tau("species_ratio")},
    {"correlation-trace", "correlated part of the energy", along_tau("correlation_trace")},
    {"clusters", "largest cluster", along_tau("largest_cluster")},
    {"distribution", "velocity distribution at the end", logarithmic(profile("rho"))},
    {"correlation-parallel", "velocity correlation along the separation, at the end",
     profile("G_parallel")},
    {"correlation-perpendicular", "velocity correlation across the separation, at the end",
     profile("G_perpendicular")},
    {"structure", "structure factor at the end", logarithmic(profile("S"))},
    {"pair-distribution", "pair distribution at the end", profile("g")},
    {"spectrum-transverse", "energy spectrum of transverse modes at the end",
     doubly_logarithmic(profile("E_perpendicular"))},
    {"spectrum-longitudinal", "energy spectrum of longitudinal modes at the end",
     doubly_logarithmic(profile("E_parallel"))},
    {"tail", "tail of the velocity distribution at the end", logarithmic(profile("tail"))},
    {"cluster-sizes", "particles in clusters of each size at the end",
     doubly_logarithmic(profile("cluster_sizes"))},
    {"free-times", "free times of particles, at the end", logarithmic(profile("free_times"))},
    {"impacts", "impact parameters, at the end", profile("impacts")},
    {"normal-speeds", "speeds of approach along the line of centres, at the end",
     profile("normal_speeds")},
    {"msd", "mean square displacement from each waiting time",
     doubly_logarithmic({.y = "msd", .theory_up_to = most_with_theory})},
    {"vacf",
     "velocity autocorrelation from each waiting time",
     {.y = "vacf", .theory = true, .theory_up_to = most_with_theory}},
};

}  // namespace

std::span<const GeneralFigure> general_figures() {
  return all_figures;
}

}  // namespace haff::campaign
