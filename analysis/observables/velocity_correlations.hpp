// SPDX-License-Identifier: GPL-3.0-or-later

// Spatial correlations of the velocities, measured in one state (correlations.hpp has the theory):
//
//   G_par(r)  = < (v_i . rhat)(v_j . rhat) >,   G_perp(r) = (< v_i . v_j > - G_par) / (d-1)
//
// averaged over all pairs i != j whose separation is r, in all directions. The self part of < u(r)
// u(0) > is left out, so this is G^+ at all r. By FFT: velocities are summed in cells, and the sums
// over pairs of cells at each separation R are
//
//   C_ab(R) = sum_x p_a(x + R) p_b(x),   C_n(R) = sum_x n(x + R) n(x)
//
// The effect of the cells at small r: a cell is between 1 and about 1.1 sigma wide (wider where
// this would need more than 128 cells along an axis), and the particles of a pair whose cells are R
// apart may be anywhere within their cells. So G is smoothed over about one cell, direction
// included. From r = 4 cells on this changes a G ~ 1/r by less than 1 %; at the first point, where
// pairs in contact and pairs at 2 cells are averaged together, by a tenth or more. Pairs within one
// cell have no direction and are left out.
//
// In the hydrodynamic theory Tr G^+(0) has no limit r -> 0, so that the theory cuts wave numbers
// off at k_M. The measured field is cut off in the same way,
//
//   Tr G^+(0) = sum_{0 < k <= k_M} (|p(k)|^2 - sum_i v_i^2) / N^2,   p(k) = sum_i v_i exp(-i k r_i)
//
// over transverse and longitudinal modes together, each divided by the transform of the cell. R.
// Kawahara and H. Nakanishi, cond-mat/0309130.
#pragma once

#include <span>
#include <vector>

#include "analysis/observables/mesh.hpp"

namespace haff::analysis {

struct VelocityCorrelations {
  std::vector<double> r;              // mean of a shell of separations, up to L/2 [sigma]
  std::vector<double> parallel;       // G_par^+, in the unit of v^2
  std::vector<double> perpendicular;  // G_perp^+
  double trace = 0;                   // Tr G^+(0) from modes up to k_M
};

// The correlations of N particles at positions in [0, L) with these velocities; k_M in 1/sigma
// (cutoff_wavenumber). r depends on box and d alone. For uncorrelated velocities G^+ is zero
// (-T/(mN) at given total momentum) within a standard error of T / (m sqrt(pairs in the shell)).
// Rounding: about 1e-15 of N <v^2>. A width of the cells larger than one sigma [sigma] shows the
// effect of the cells. Throws std::invalid_argument unless there are as many positions as
// velocities, at least two, and the box is wider than 4 cells.
VelocityCorrelations velocity_correlations(std::span<const Vector> position,
                                           std::span<const Vector> velocity, double box,
                                           double k_max, int d = 3, double cell = 1);

}  // namespace haff::analysis
