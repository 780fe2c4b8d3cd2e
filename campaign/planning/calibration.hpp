// What a job costs on this machine, part by part: a short trial of it.
#pragma once

#include "schema/job.hpp"

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

// Cools, or equilibrates, such a gas for some `seconds` of CPU time, at most to tau_max, and
// measures what the job does. Large gases are tried at 200 000 particles, beyond which speed hardly
// changes; crowded ones at n = 0.9, where a lattice can be had at once.
Prices try_out(const schema::Job& job, double tau_max, double seconds);

// Memory of the engine for such a gas. [bytes per particle]
double bytes_per_particle(const schema::Job& job);

}  // namespace haff::campaign
