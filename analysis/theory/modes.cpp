// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/theory/modes.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "analysis/theory/cooling.hpp"
#include "analysis/theory/enskog.hpp"

namespace haff::analysis {

ModeSpectrum modes(const Gas& gas, double k) {
  const double rate = gamma0(gas.e, gas.d);
  const Lengths length = lengths(gas);
  const EquationOfState state = equation_of_state(gas.n, gas.d);
  const double k2 = k * k;
  const std::complex<double> ikl(0, k * length.free_path);

  Eigen::Matrix3cd matrix;
  matrix << 0, -ikl, 0,                                                             //
      -0.5 * ikl * state.stiffness, rate * (1 - length.sound * length.sound * k2),  //
      -0.5 * ikl * state.z,                                                         //
      -2 * rate * state.g, -2 * state.z / gas.d * ikl,                              //
      -rate * (1 + length.heat * length.heat * k2);
  const Eigen::ComplexEigenSolver<Eigen::Matrix3cd> solver(matrix, false);
  if (solver.info() != Eigen::Success) throw std::runtime_error("mode spectrum did not converge");

  ModeSpectrum spectrum{
      .transverse = rate * (1 - length.transverse * length.transverse * k2),
      .longitudinal = {solver.eigenvalues()[0], solver.eigenvalues()[1], solver.eigenvalues()[2]}};
  std::ranges::sort(spectrum.longitudinal, [](const auto& a, const auto& b) {
    // Conjugate pairs agree in their real parts only to rounding.
    constexpr double same = 1e-12;  // far below gamma_0 [1/tau]
    if (std::abs(a.real() - b.real()) > same) return a.real() > b.real();
    return a.imag() > b.imag();
  });
  return spectrum;
}

InstabilityBounds instability_bounds(const Gas& gas) {
  const Lengths length = lengths(gas);
  const EquationOfState state = equation_of_state(gas.n, gas.d);
  const double excess = 2 * state.z * state.g / state.stiffness - 1;
  return {.shear = 1 / length.transverse, .heat = std::sqrt(std::max(0.0, excess)) / length.heat};
}

}  // namespace haff::analysis
