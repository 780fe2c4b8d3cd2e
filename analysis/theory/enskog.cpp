// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/theory/enskog.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "analysis/theory/cooling.hpp"

namespace haff::analysis {

using std::numbers::pi;

double packing_fraction(double n, int d) {
  if (d != 2 && d != 3) throw std::invalid_argument("Enskog theory: dimension must be 2 or 3");
  return d == 2 ? pi * n / 4 : pi * n / 6;
}

double contact_value(double n, int d) {
  const double phi = packing_fraction(n, d);
  if (!(phi >= 0 && phi < 1)) {
    throw std::invalid_argument("Enskog theory: the packing fraction must lie in [0, 1)");
  }
  if (d == 2) return (1 - 7 * phi / 16) / ((1 - phi) * (1 - phi));
  return (1 - phi / 2) / ((1 - phi) * (1 - phi) * (1 - phi));
}

EquationOfState equation_of_state(double n, int d) {
  const double phi = packing_fraction(n, d);
  const double chi = contact_value(n, d);
  const double chi_slope = d == 2 ? phi * (2 / (1 - phi) - 7 / (16 - 7 * phi))
                                  : phi * (3 / (1 - phi) - 1 / (2 - phi));  // d ln chi / d ln n
  const double excess = (d == 2 ? 2 : 4) * phi * chi;                       // z - 1
  const double g = 1 + chi_slope;
  return {.z = 1 + excess, .g = g, .stiffness = 1 + excess + excess * g};
}

Transport transport(double n, double temperature, int d) {
  const double phi = packing_fraction(n, d);
  const double chi = contact_value(n, d);
  const double thermal = std::sqrt(temperature / pi);
  const double v0 = std::sqrt(2 * temperature);
  const double rate = unit_sphere_surface(d) * chi * n * v0 / std::sqrt(2 * pi);
  if (d == 2) {
    return {.collision_rate = rate,
            .viscosity =
                0.5 * thermal * (1.022 / chi + 2.044 * phi + (1.022 + 8 / pi) * phi * phi * chi),
            .bulk_viscosity = 8 / pi * thermal * phi * phi * chi,
            .conductivity = 1.029 * 2 * thermal * (1 / chi + 3 * phi + 3.487 * phi * phi * chi)};
  }
  const double y = 4 * phi;
  return {.collision_rate = rate,
          .viscosity = 1.016 * 5 / 16 * thermal * (1 / chi + 0.8 * y + 0.7614 * y * y * chi),
          .bulk_viscosity = thermal / pi * y * y * chi,
          .conductivity = 1.025 * 75 / 64 * thermal * (1 / chi + 1.2 * y + 0.757 * y * y * chi)};
}

Lengths lengths(const Gas& gas) {
  const double rate = gamma0(gas.e, gas.d);
  if (!(rate > 0)) {
    throw std::invalid_argument("an elastic gas has no correlation length: e must be below 1");
  }
  const Transport at_unit = transport(gas.n, 1, gas.d);
  const EquationOfState state = equation_of_state(gas.n, gas.d);
  const double per_decay = 1 / (at_unit.collision_rate * rate);
  const double nu = at_unit.viscosity / gas.n;
  const double nu_l =
      (2.0 * (gas.d - 1) / gas.d * at_unit.viscosity + at_unit.bulk_viscosity) / gas.n;
  const double l0 = std::numbers::sqrt2 / at_unit.collision_rate;
  const double xi_l_squared = nu_l * per_decay;
  const double compression = state.z - state.g + state.z * state.z / gas.d;
  return {.free_path = l0,
          .transverse = std::sqrt(nu * per_decay),
          .sound = std::sqrt(xi_l_squared),
          .heat = std::sqrt(2 * at_unit.conductivity / (gas.d * gas.n) * per_decay),
          .longitudinal = std::sqrt(xi_l_squared + l0 * l0 / (2 * rate * rate) * compression)};
}

}  // namespace haff::analysis
