// SPDX-License-Identifier: GPL-3.0-or-later

// The energy spectrum of the flow, E(k) of observables/energy_spectrum.hpp: in equilibrium, and in
// the cooling gas by fluctuating hydrodynamics.
//
//   E_par     Omega_d k^(d-1) T / (2 n (2 pi)^d) in equilibrium,   E_perp = (d-1) E_par
//   s         2 gamma_0 tau
//   ratio     1 + (e^(s (1 - xi^2 k^2)) - 1) / (1 - xi^2 k^2), with xi_perp or xi_par (enskog.hpp),
//             times equilibrium at Haff's temperature: 1 for k >> 1/xi, e^s for k -> 0, where the
//             flow keeps its energy
//
// This is the transform of G_perp and G_par of correlations.hpp, with the self part: T. P. C. van
// Noije, M. H. Ernst, R. Brito and J. A. G. Orza, Phys. Rev. Lett. 79, 411 (1997). For longitudinal
// modes it holds only where k l_0 is well below gamma_0 (modes.hpp).
#pragma once

#include "analysis/theory/gas.hpp"

namespace haff::analysis {

// E(k) in equilibrium at temperature T, in the unit of T sigma; k in 1/sigma.
double equilibrium_spectrum(double k, double n, double temperature, bool is_parallel, int d = 3);

// The ratio above. Throws std::invalid_argument at e = 1, where the ratio is 1.
double spectrum_ratio(const Gas& gas, double k, double tau, bool is_parallel);

}  // namespace haff::analysis
