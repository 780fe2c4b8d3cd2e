// SPDX-License-Identifier: GPL-3.0-or-later

// The kinetic energy of the flow by wave number: transverse and longitudinal modes, and vorticity.
//
//   p(k)      sum_i m_i v_i exp(-i k r_i), for k > 0;  p_par = (p . khat) khat,  p_perp = p - p_par
//   M         sum_i m_i
//   rho(k)    Omega_d k^(d-1) V / (2 pi)^d, modes per unit of wave number
//   E(k)      rho(k) < |p(k)|^2 > / (2 M N), of p_perp and of p_par: the energy per particle
//             and unit of wave number, including the thermal motion of the particles
//   Z(k)      k^2 E_perp(k): the same for the vorticity k x u, the spectrum of enstrophy
//
// In an elastic gas all modes have the same energy (equipartition): E_par = rho T / (2N), E_perp =
// (d-1) E_par, with rho/N = Omega_d k^(d-1) / (n (2 pi)^d). In a cooling gas the noise of
// collisions feeds the modes, and modes of long waves decay more slowly than the gas cools: with
// s = 2 gamma_0 tau and T_Haff,
//   E / E_equilibrium = 1 + (e^(s (1 - xi^2 k^2)) - 1) / (1 - xi^2 k^2),   xi = xi_perp, xi_par:
// T. P. C. van Noije, M. H. Ernst, R. Brito and J. A. G. Orza, Phys. Rev. Lett. 79, 411 (1997).
//
// By FFT on a mesh, as in structure.hpp; the effect of the mesh on a mode is corrected. Only shells
// up to half of the mesh's largest wave number are kept.
#pragma once

#include <span>
#include <vector>

#include "analysis/observables/mesh.hpp"

namespace haff::analysis {

struct EnergySpectrum {
  std::vector<double> k;             // mean of a shell of modes, one shell every 2 pi / L [1/sigma]
  std::vector<double> transverse;    // E_perp, in the unit of m v^2 sigma
  std::vector<double> longitudinal;  // E_par
  std::vector<double> enstrophy;     // Z
};

// The spectrum of particles at positions in [0, L) with these velocities; an empty `mass` means
// that all masses are 1. k depends on box and d alone. The standard error of one state is about E
// sqrt(2 / modes in the shell), and smaller by sqrt(2) for E_perp in 3-d. Throws
// std::invalid_argument for a box smaller than 8 sigma, for no particles, or for arrays of
// different lengths.
EnergySpectrum energy_spectrum(std::span<const Vector> position, std::span<const Vector> velocity,
                               std::span<const double> mass, double box, int d = 3);

}  // namespace haff::analysis
