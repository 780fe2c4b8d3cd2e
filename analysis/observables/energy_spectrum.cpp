// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/observables/energy_spectrum.hpp"

#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>

#include "analysis/observables/fourier.hpp"
#include "analysis/observables/sharing.hpp"
#include "analysis/theory/gas.hpp"

namespace haff::analysis {
namespace {

// sum_i p_i p_i, the value of p(k) p*(k) without correlations.
using Tensor = std::array<std::array<double, 3>, 3>;

template <class Momentum>
Tensor self_part(std::size_t particles, std::size_t axes, Momentum&& momentum) {
  Tensor self{};
  for (std::size_t i = 0; i < particles; ++i)
    for (std::size_t a = 0; a < axes; ++a)
      for (std::size_t b = 0; b < axes; ++b) self[a][b] += momentum(i, a) * momentum(i, b);
  return self;
}

}  // namespace

EnergySpectrum energy_spectrum(std::span<const Vector> position, std::span<const Vector> velocity,
                               std::span<const double> mass, double box, int d) {
  const std::size_t particles = position.size();
  if (particles == 0 || velocity.size() != particles ||
      (!mass.empty() && mass.size() != particles) || !(box >= smallest_spectral_box))
    throw std::invalid_argument(
        "an energy spectrum needs as many velocities as positions and a box of 8 sigma");
  const Mesh mesh{.box = box, .cells = transform_cells(box), .d = d};
  const auto axes = static_cast<std::size_t>(d);
  const auto momentum = [&](std::size_t i, std::size_t axis) {
    return mass.empty() ? velocity[i][axis] : mass[i] * velocity[i][axis];
  };
  double total_mass = 0;
  for (std::size_t i = 0; i < particles; ++i) total_mass += mass.empty() ? 1 : mass[i];

  Fourier fourier(mesh);
  std::vector<std::vector<std::complex<double>>> p;
  p.reserve(axes);
  for (std::size_t a = 0; a < axes; ++a) {
    share_out(position, mesh, fourier.field(), [&](std::size_t i) { return momentum(i, a); });
    fourier.forward();
    p.emplace_back(fourier.modes().begin(), fourier.modes().end());
  }

  const Tensor self = self_part(particles, axes, momentum);
  double self_trace = 0;
  for (std::size_t a = 0; a < axes; ++a) self_trace += self[a][a];
  const auto axis = distortions(mesh.cells);
  const auto at = [&](int wave) { return axis[static_cast<std::size_t>(std::abs(wave))]; };
  const std::size_t shift = 3 - axes;  // for d = 2 the first wave number is empty

  const auto shells = static_cast<std::size_t>(mesh.cells / 4);
  std::vector<double> along(shells), across(shells), rotation(shells), k_sum(shells), count(shells);
  fourier.for_each_mode([&](std::size_t number, const std::array<int, 3>& k, int weight) {
    const double square = k[0] * k[0] + k[1] * k[1] + k[2] * k[2];
    const double length = std::sqrt(square);
    const auto shell = static_cast<std::size_t>(std::lround(length));
    if (shell < 1 || shell > shells) return;
    std::complex<double> projected;
    double raw = 0, self_along = 0;
    for (std::size_t a = 0; a < axes; ++a) {
      projected += p[a][number] * (k[a + shift] / length);
      raw += std::norm(p[a][number]);
      for (std::size_t b = 0; b < axes; ++b)
        self_along += self[a][b] * k[a + shift] * k[b + shift] / square;
    }
    const double power = at(k[0]).power * at(k[1]).power * at(k[2]).power;
    const double folded = at(k[0]).folded * at(k[1]).folded * at(k[2]).folded;
    const auto corrected = [&](double found, double alone) {
      return alone + (found - alone * folded) / power;
    };
    const double parallel = corrected(std::norm(projected), self_along);
    const double both = corrected(raw, self_trace);
    along[shell - 1] += weight * parallel;
    across[shell - 1] += weight * (both - parallel);
    rotation[shell - 1] += weight * square * (both - parallel);
    k_sum[shell - 1] += weight * length;
    count[shell - 1] += weight;
  });

  EnergySpectrum result;
  const double k_unit = 2 * std::numbers::pi / box;
  const double density = unit_sphere_surface(d) / std::pow(k_unit, d);
  for (std::size_t s = 0; s < shells; ++s) {
    const double k = k_unit * k_sum[s] / count[s];
    const double modes = density * (d == 3 ? k * k : k);
    const double each = modes / (2 * total_mass * static_cast<double>(particles) * count[s]);
    result.k.push_back(k);
    result.transverse.push_back(each * across[s]);
    result.longitudinal.push_back(each * along[s]);
    result.enstrophy.push_back(each * k_unit * k_unit * rotation[s]);
  }
  return result;
}

}  // namespace haff::analysis
