// SPDX-License-Identifier: GPL-3.0-or-later

// Figure 8: the coarse-grained velocity field at e = 0.80, tau = 60. Three neighbouring layers of
// cells, 3/32 of z, and of each a quarter of the xy plane. An arrow is the velocity in the plane,
// its length and tone its size in units of the thermal velocity v_0 = sqrt(2 T / m).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "campaign/base/text/number_text.hpp"
#include "campaign/base/text/text_table.hpp"
#include "campaign/paper/figure.hpp"

namespace haff::campaign {
namespace {

constexpr int layers = 3;
constexpr double longest_arrow = 1.6;  // cells

// Velocities in the plane of layer k, arrows that start half their length before the cell's middle.
Curve slice(const VelocityField& gas, int k) {
  const schema::Field& field = gas.field;
  const int cells = field.cells;
  const double cell = field.box / cells;
  const double unit = std::sqrt(2 * gas.temperature);  // v_0
  Curve curve{
      .name = fmt::format("layer {}", k + 1), .e = gas.e, .n = gas.n, .particles = gas.particles};
  curve.look = Look::arrows;
  for (int i = 0; i < cells / 2; ++i) {
    for (int j = 0; j < cells / 2; ++j) {
      const double* velocity =
          field.values.data() +
          ((static_cast<std::ptrdiff_t>(i) * cells + j) * cells + k) * field.components;
      curve.x.push_back((i + 0.5) * cell);
      curve.y.push_back((j + 0.5) * cell);
      curve.arrow.push_back({velocity[0] / unit, velocity[1] / unit});
      curve.realizations.push_back(1);
    }
  }
  return curve;
}

// The store may be damaged, or made by another program: as many values as the layers are read from.
void check(const schema::Field& field) {
  constexpr int most_cells = 1000;  // along an axis: more is no count of cells
  const bool counted = field.cells > 0 && field.cells <= most_cells && field.components == 3;
  const auto cells = static_cast<std::size_t>(counted ? field.cells : 0);
  const bool sound = counted && field.values.size() == 3 * cells * cells * cells &&
                     std::isfinite(field.box) && field.box > 0;
  if (!sound)
    throw std::runtime_error(fmt::format(
        "the velocity field at τ = {:g} is damaged: {} values for {} cells along each axis; "
        "\"campaign verify\" says more",
        field.tau, field.values.size(), field.cells));
}

double length(const std::array<double, 2>& arrow) {
  return std::hypot(arrow[0], arrow[1]);
}

}  // namespace

std::optional<Plot> figure_08(const Averages& averages) {
  if (!averages.velocity_field) return std::nullopt;
  const VelocityField& gas = *averages.velocity_field;
  check(gas.field);
  if (gas.field.cells < layers) return std::nullopt;
  const double half = gas.field.box / 2, cell = gas.field.box / gas.field.cells;

  std::vector<Curve> slices;
  double fastest = 0;
  for (int k = 0; k < layers; ++k) {
    slices.push_back(slice(gas, k));
    for (const auto& arrow : slices.back().arrow) {
      if (std::isfinite(length(arrow))) fastest = std::max(fastest, length(arrow));
    }
  }
  Plot plot{.panels = {}, .width = 1160};
  for (int k = 0; k < layers; ++k) {
    Panel panel{
        .name = slices[static_cast<std::size_t>(k)].name,
        .x = {.label = "{/:Italic x} / {/:Italic σ}", .column = "x", .low = 0, .high = half},
        .y = {.label = k == 0 ? "{/:Italic y} / {/:Italic σ}" : "",
              .column = "y",
              .low = 0,
              .high = half},
        .curves = {std::move(slices[static_cast<std::size_t>(k)])},
        .legend = "none",
        .arrow_scale = longest_arrow * cell / fastest,
        .tone_high = fastest};
    // Three squares in a row, room for the scale of tones at the right.
    const double left = 0.065 + 0.29 * k;
    panel.frame = {{left, left + 0.27, 0.23, 0.23 + 0.27 * 1160 / 480}};
    if (k > 0) panel.y.tics = "format ''";
    panel.commands.push_back(fmt::format(
        "set label '{:.1f} ≤ {{/:Italic z}}/{{/:Italic σ}} < {:.1f}' at graph 0.5, graph 1.05 "
        "center",
        k * cell, (k + 1) * cell));
    panel.tone_label = k == layers - 1 ? "|{/:Bold u}_{/:Italic xy}| / {/:Italic v}_0" : "";
    plot.panels.push_back(std::move(panel));
  }
  plot.caption = fmt::format(
      "e = {}, n = {}, N = {}, seed {}, τ = {:g}: {}³ cells of {:.2f} σ, three layers, a quarter "
      "of the plane. haff {}.",
      restitution_text(gas.e), density_text(gas.n), count_text(gas.particles), gas.seed,
      gas.field.tau, gas.field.cells, cell, gas.code_version);
  return plot;
}

}  // namespace haff::campaign
