// SPDX-License-Identifier: GPL-3.0-or-later

// How a gas cools: Haff's law, the measured decay rate, the end of the homogeneous stage.
//
//   2 gamma_0     = (1 - e^2) / d                    decay rate of T on the clock tau
//   T_Haff(tau)   = T_0 exp(-2 gamma_0 tau),  T_0 = 2/d  (energy E(0) = 1 per particle)
//   tau_c         : first tau with T_Haff(tau) = T(tau) / 2
//
// P. K. Haff, J. Fluid Mech. 134, 401 (1983); R. Kawahara and H. Nakanishi, cond-mat/0309130.
// tau counts collisions suffered per particle: tau = 2 C / N after C pair collisions.
#pragma once

#include <optional>
#include <span>

namespace haff::analysis {

// gamma_0 of restitution coefficient e in d dimensions [1/tau]. Zero at e = 1.
double gamma0(double e, int d = 3);

// T at the start: 2/d, in units of E(0) / particle.
double initial_temperature(int d = 3);

// Haff's law [E(0)].
double haff_temperature(double tau, double e, int d = 3);

// gamma / gamma_0 averaged between two samples interval [tau] apart, from the energies (or
// temperatures) at both: ln(before/after) / (2 gamma_0 interval). The value belongs to the middle
// of the interval. NaN at e = 1, where gamma_0 = 0.
double gamma_ratio(double before, double after, double interval, double e, int d = 3);

// Collision frequency of one particle: 2 pair collisions / (N elapsed) [1/time].
double collision_rate(double pair_collisions, double particles, double elapsed);

// The mean of T over time between the last two of these samples (at least two, in order of time).
//
// By Haff's law T^(-1/2) is a straight line in time, and the mean of T between two samples is
// exactly the geometric mean, sqrt(T_before T_after). Where the gas departs from Haff's law,
// T^(-1/2) is taken from the cubic through the last four samples (from a parabola through three),
// which leaves an error of the fourth order in the interval (third; second with two samples). Only
// + - x / and sqrt are used, so that the result has the same bits everywhere.
double mean_temperature(std::span<const double> time, std::span<const double> temperature);

// Pressure n T + virial / (d V elapsed) [energy/volume], V = N/n. `virial` is the sum of sigma
// |momentum transfer| over the collisions of the time `elapsed`, and `temperature` is the mean over
// that time.
double pressure(double n, double temperature, double virial, double particles, double elapsed,
                int d = 3);

// tau_c of a series of temperatures [E(0)] at increasing tau; ln(T/T_Haff) is interpolated linearly
// between samples (error of order (sample interval)^2 d^2 ln T/dtau^2 / 8 over the slope). Nothing
// if the series does not reach tau_c. Throws std::invalid_argument if the lengths differ.
std::optional<double> tau_c(std::span<const double> tau, std::span<const double> temperature,
                            double e, int d = 3);

}  // namespace haff::analysis
