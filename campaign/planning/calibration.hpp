// SPDX-License-Identifier: GPL-3.0-or-later

// What a job costs on this machine, part by part: a short trial of it.
#pragma once

#include "schema/grid/job.hpp"

namespace haff::campaign {

// CPU time of the parts of a job. [s]
struct Prices {
  double start = 0;            // the first state, and the first event of every particle
  double collision = 0;        // with what effects add
  double synchronization = 0;  // of those that every gas has
  double sample = 0;
  double profiles = 0;  // all of them once
  double fields = 0;    // the same
  double commit = 0;    // storing the state
};

// Cools, or equilibrates, such a gas for `seconds` of CPU time, at most to tau_max, and times the
// parts of the job. Large gases are tried with 200 000 particles, beyond which speed hardly
// changes; dense ones that begin on a lattice at n = 0.9; those that must grow, which takes longer
// than anything else, with 500. What happens once in a process is not in these prices.
Prices try_out(const schema::Job& job, double tau_max, double seconds);

// The memory that a particle of such a gas takes. [bytes]
struct Sizes {
  double engine = 0;  // of the memory of a running job
  double state = 0;   // of a stored state
};
Sizes sizes(const schema::Job& job);

}  // namespace haff::campaign
