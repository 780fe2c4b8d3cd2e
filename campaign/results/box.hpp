// SPDX-License-Identifier: GPL-3.0-or-later

// Whether a box can hold what a cooling gas grows: vortices and clusters, by linear theory.
//
// The homogeneously cooling gas is unstable against waves that are long enough (analysis/theory/
// modes.hpp). A periodic box of side L holds waves of length L / sqrt(1, 2, 3, ...) alone: a box
// shorter than the shortest unstable wave never leaves Haff's law.
#pragma once

#include <optional>
#include <string>

#include "schema/grid/job.hpp"

namespace haff::campaign {

struct BoxReport {
  double side = 0;                     // L [sigma]
  double vortex_length = 0;            // 2 pi xi_perp: longer transverse waves grow [sigma]
  double cluster_length = 0;           // 2 pi xi_par [sigma]
  std::optional<double> heat_length;   // longer waves of the heat mode grow; nothing: none does
  double vortices_across = 0;          // L / vortex_length: how many of the shortest growing waves
  double clusters_across = 0;          // fit; below 1 none does
  std::optional<double> fastest_wave;  // length of the wave in this box that grows fastest [sigma]
  std::optional<double> fastest_rate;  // its growth rate [1/tau]
  std::optional<double> waves_across;  // how many of it fit along the box
  std::optional<double> grown_tau;     // tau at which it has grown by a factor e = 2.718
  double haff_particles = 0;           // N up to which, at this n, the gas keeps to Haff's law
  bool keeps_haff = false;             // the box is too small for any growing wave
};

// Nothing for gases that linear theory does not treat: elastic ones, other laws of restitution,
// mixtures, rough particles, a thermostat, shuffled velocities, equilibrations.
std::optional<BoxReport> box_report(const schema::Job& job);

// A warning where the box is too small to leave Haff's law, else empty.
std::string haff_warning(const schema::Job& job, const BoxReport& report);

}  // namespace haff::campaign
