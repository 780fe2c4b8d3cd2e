// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/paper/figures.hpp"

#include <array>
#include <string>

#include "campaign/paper/figure.hpp"
#include "campaign/results/published.hpp"

namespace haff::campaign {
namespace {

constexpr std::string_view four_restitutions =
    R"({ "e": [0.80, 0.85, 0.90, 0.95], "n": 0.4, "N": 32000, "seeds": 3,
  "tau_max": {"0.80": 180, "0.85": 250, "0.90": 400, "0.95": 470},
  "observables": ["temperature", "laguerre"] })";
constexpr std::string_view one_restitution =
    R"({ "e": 0.90, "n": 0.4, "N": 32000, "seeds": 6, "tau_max": 400,
  "observables": ["temperature", "laguerre"] })";

constexpr std::string_view shuffled =
    R"({ "e": 0.85, "n": 0.4, "N": 32000, "seeds": 4, "tau_max": 100,
  "effects": [{}, {"shuffle": {"every": 1}}] })";
constexpr std::string_view several_densities =
    R"({ "e": 0.85, "n": [0.05, 0.1, 0.2, 0.4, 0.5], "N": 32000, "seeds": 3, "tau_max": 90,
  "observables": ["temperature", "laguerre"] })";

constexpr std::string_view boxes =
    R"({ "e": 0.80, "n": 0.4, "N": [300, 450, 563, 700, 1000], "seeds": 16, "tau_max": 400,
  "sample_every": 10 })";

constexpr std::string_view distribution =
    R"({ "e": 0.80, "n": 0.4, "N": 32000, "seeds": 3, "tau_max": 180, "profiles_every": 10,
  "observables": ["temperature", "laguerre", "distribution"] })";
constexpr std::string_view correlations =
    R"({ "e": 0.80, "n": 0.4, "N": 256000, "seeds": 1, "tau_max": 60, "profiles_every": 10,
  "fields_at": 60, "observables": ["temperature", "laguerre", "correlations", "fields"] })";

}  // namespace

std::span<const PaperFigure> paper_figures() {
  static const std::string crossovers = published_tau_c_text();
  static const std::array<PaperFigure, 15> figures = {{
      {1, "temperature against Haff's law", figure_01, four_restitutions,
       "Haff's law, then a slower decay from τ_c on; late in the clustering stage roughly "
       "T ~ τ^−3 to τ^−4, strongly sample dependent."},
      {2, "duration of the homogeneous stage", figure_02, four_restitutions, crossovers},
      {3, "velocity distribution", figure_03, distribution,
       "close to exp(−c²) throughout the homogeneous stage."},
      {4, "Laguerre coefficients a₂, a₃, a₄", figure_04, one_restitution,
       "|a₂| > |a₃| > |a₄|; all return towards zero before τ_c (mean of 3)."},
      {5, "a₂ against Enskog–Boltzmann theory", figure_05, one_restitution,
       "a₂ follows the theory until close to the value that this settles to, then turns back "
       "(mean of 3, inset of 6)."},
      {6, "a₂ at short times for several densities", figure_06, several_densities,
       "the return of a₂ is slower at low n (densities not listed in the text)."},
      {7, "a₂ against τ/τ_c", figure_07, four_restitutions,
       "small until τ_c, then large and different in every sample; smoothed over Δτ = 3, 3, 5, 7."},
      {8, "velocity field", figure_08, correlations,
       "vortices much larger than a cell at τ = 60 (N = 1 000 000)."},
      {9, "velocity correlations", figure_09, correlations,
       "G∥ and G⊥ at τ = 50 beside incompressible theory (N = 1 000 000)."},
      {10, "scaling of velocity correlations", figure_10, correlations,
       "G τ^(d/2) against r/√τ falls on one curve for 20 ≤ τ ≤ 60 (N = 1 000 000)."},
      {11, "decay rate in the early stage", figure_11, four_restitutions,
       "γ < γ₀ from the start, by far more than Enskog–Boltzmann theory has it; b = 0.30 fits "
       "all e."},
      {12, "decay rate for several densities", figure_12, several_densities,
       "the same b = 0.30 fits all n."},
      {13, "energy above Haff's law", figure_13, four_restitutions,
       "the energy equation with b = 0.30 until τ_c, where E − E_Haff meets E_Haff."},
      {14, "shuffled against not", figure_14, shuffled,
       "not drawn there, but argued with: without correlations a₂ keeps the value that it first "
       "settles to."},
      {15, "boxes below and above the smallest that holds a vortex", figure_15, boxes,
       "not of the paper: hydrodynamics says that γ/γ₀ stays constant below L_c = 2πξ⊥ and "
       "tends to (L_c/L)² above."},
  }};
  return figures;
}

}  // namespace haff::campaign
