// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/curves/labels.hpp"

#include <algorithm>
#include <array>

#include "campaign/base/text/printable.hpp"

namespace haff::campaign {
namespace {

struct Label {
  std::string_view name, symbol;
  std::string_view unit = {};
};

constexpr std::array labels{
    Label{"tau", "{/:Italic τ}"},
    Label{"time", "{/:Italic t}", "{/:Italic σ} ({/:Italic m}/{/:Italic E}_0)^{1/2}"},
    Label{"temperature", "{/:Italic T}", "{/:Italic E}_0"},
    Label{"energy", "{/:Italic E}", "{/:Italic E}_0"},
    Label{"gamma_ratio", "{/:Italic γ} / {/:Italic γ}_0"},
    Label{"collision_rate", "{/:Italic ω}", "({/:Italic E}_0/{/:Italic m})^{1/2}/{/:Italic σ}"},
    Label{"pressure", "{/:Italic p}", "{/:Italic E}_0/{/:Italic σ}^{/:Italic d}"},
    Label{"a2", "{/:Italic a}_2"},
    Label{"a3", "{/:Italic a}_3"},
    Label{"a4", "{/:Italic a}_4"},
    Label{"a5", "{/:Italic a}_5"},
    Label{"a6", "{/:Italic a}_6"},
    Label{"correlation_trace", "Tr {/:Italic G}^+(0)", "{/:Italic E}_0/{/:Italic m}"},
    Label{"largest_cluster", "share of particles in the largest cluster"},
    Label{"rotational_temperature", "{/:Italic T}_{rot}", "{/:Italic E}_0"},
    Label{"rotational_ratio", "{/:Italic T}_{rot} / {/:Italic T}"},
    Label{"temperature_1", "{/:Italic T}_1", "{/:Italic E}_0"},
    Label{"temperature_2", "{/:Italic T}_2", "{/:Italic E}_0"},
    Label{"species_ratio", "{/:Italic T}_1 / {/:Italic T}_2"},
    Label{"Z", "{/:Italic p} / ({/:Italic n T})"},
    Label{"ln_temperature", "ln({/:Italic T} / {/:Italic T}_0)"},
    Label{"tau_c", "{/:Italic τ}_c"},
    Label{"rho", "{/:Italic ρ}"},
    Label{"G_parallel", "{/:Italic G}_{∥}", "{/:Italic E}_0/{/:Italic m}"},
    Label{"G_perpendicular", "{/:Italic G}_{⊥}", "{/:Italic E}_0/{/:Italic m}"},
    Label{"S", "{/:Italic S}"},
    Label{"S_11", "{/:Italic S}_{11}"},
    Label{"S_12", "{/:Italic S}_{12}"},
    Label{"S_22", "{/:Italic S}_{22}"},
    Label{"tail", "{/:Italic ρ}"},
    Label{"tail_exponent", "{/:Italic α}"},
    Label{"g", "{/:Italic g}"},
    Label{"g_11", "{/:Italic g}_{11}"},
    Label{"g_12", "{/:Italic g}_{12}"},
    Label{"g_22", "{/:Italic g}_{22}"},
    Label{"E_perpendicular", "{/:Italic E}_{⊥}", "{/:Italic E}_0 {/:Italic σ}"},
    Label{"E_parallel", "{/:Italic E}_{∥}", "{/:Italic E}_0 {/:Italic σ}"},
    Label{"enstrophy", "{/:Italic k}^2 {/:Italic E}_{⊥}", "{/:Italic E}_0/{/:Italic σ}"},
    Label{"cluster_sizes", "share of particles in clusters of {/:Italic s} to 2{/:Italic s}−1"},
    Label{"mean_cluster", "mean size of a particle's cluster"},
    Label{"free_times", "density of free times"},
    Label{"impacts", "density of impact parameters"},
    Label{"normal_speeds", "density of speeds of approach"},
    Label{"msd", "⟨Δ{/:Italic r}^2⟩", "{/:Italic σ}^2"},
    Label{"diffusion", "{/:Italic D} / {/:Italic ω}", "{/:Italic σ}^2"},
    Label{"vacf",
          "⟨{/:Italic v}({/:Italic τ}_w)·{/:Italic v}⟩ / ({/:Italic v}_{rms} {/:Italic v}_{rms})"},
    Label{"lag", "{/:Italic τ} − {/:Italic τ}_w"},
    Label{"tau_w", "{/:Italic τ}_w"},
    Label{"u", "{/:Italic ω t}"},
    Label{"b", "({/:Italic b}/{/:Italic σ})^{{/:Italic d}−1}"},
    Label{"w", "{/:Italic v}_n ({/:Italic μ}/{/:Italic T})^{1/2}"},
    Label{"s", "{/:Italic s}"},
    Label{"c", "{/:Italic c} = {/:Italic v} / {/:Italic v}_0"},
    Label{"r", "{/:Italic r}", "{/:Italic σ}"},
    Label{"k", "{/:Italic k}", "1/{/:Italic σ}"},
    Label{"d", "{/:Italic d}"},
    Label{"e", "{/:Italic e}"},
    Label{"n", "{/:Italic n}", "{/:Italic σ}^{-{/:Italic d}}"},
    Label{"N", "{/:Italic N}"},
    Label{"particles", "{/:Italic N}"},
    Label{"seed", "seed"},
    Label{"sample_every", "Δ{/:Italic τ}"},
    Label{"roughness.beta", "{/:Italic β}"},
    Label{"roughness.q", "{/:Italic q}"},
    Label{"mixture.fraction", "{/:Italic x}_2"},
    Label{"mixture.diameter_ratio", "{/:Italic σ}_2/{/:Italic σ}_1"},
    Label{"mixture.mass_ratio", "{/:Italic m}_2/{/:Italic m}_1"},
    Label{"thermostat.rate", "heating"},
    Label{"shuffle.every", "shuffled every Δ{/:Italic τ}"},
    Label{"restitution.law", "law"},
    Label{"restitution.A", "{/:Italic A}"},
    Label{"restitution.t_c", "{/:Italic t}_c"},
    Label{"restitution.speed", "{/:Italic v}_0"},
};

const Label* find(std::string_view name) {
  const auto found = std::ranges::find(labels, name, &Label::name);
  return found == labels.end() ? nullptr : &*found;
}

}  // namespace

std::string literal(std::string_view text) {
  constexpr std::string_view markup = "{}^_@&~\\";
  std::string result;
  for (const char c : printable(text)) {
    if (markup.find(c) != std::string_view::npos) result += '\\';
    result += c;
  }
  return result;
}

std::string symbol(std::string_view name) {
  const Label* label = find(name);
  return label == nullptr ? literal(name) : std::string(label->symbol);
}

std::string axis_label(std::string_view name) {
  const Label* label = find(name);
  std::string text = symbol(name);
  if (label != nullptr && !label->unit.empty()) text += "  [" + std::string(label->unit) + "]";
  return text;
}

}  // namespace haff::campaign
