// SPDX-License-Identifier: GPL-3.0-or-later

// Where on the tau axis a cooling job stops: to sample, and to store its state.
//
// Samples fall on tau = k sample_every. The engine synchronizes at multiples of its period, and
// only there can a state be stored: at the first synchronization at or after each multiple of
// checkpoint_every, and at the last one before the end, from which a longer run would go on.
#pragma once

#include <cstdint>
#include <optional>

#include "schema/grid/job.hpp"

namespace haff::campaign {

// The number of samples of a job run to tau_max, that at tau = 0 included. A sample that rounding
// puts just above tau_max (3 x 0.1 > 0.3) is one of them.
std::int64_t sample_count(double sample_every, double tau_max);

// tau of sample k, the same bits everywhere.
double sample_tau(double sample_every, std::int64_t k);

// Whether profiles, or fields, are taken with the sample at tau.
bool has_profiles(const schema::Job& job, double tau);
bool has_fields(const schema::Job& job, double tau);

// tau of synchronization k.
double synchronization_tau(std::int64_t k);

// The first synchronization at or after tau.
std::int64_t synchronization_at_or_after(double tau);

// Whether synchronization k is the first at or after a multiple of checkpoint_every.
bool is_checkpoint(std::int64_t k, double checkpoint_every);

struct Stop {
  enum class Due { sample, synchronization };

  Due due = Due::sample;
  double tau = 0;
  std::int64_t collisions = 0;
  bool keep = false;  // a synchronization whose state is stored in any case
};

class Timetable {
 public:
  // All stops of the job up to tau_max, in the order of collisions, samples first.
  Timetable(const schema::Job& job, double tau_max, double checkpoint_every);

  // Leaves out what a state stored after so many collisions has behind it.
  void skip_through(std::int64_t collisions);

  // The next stop; nothing at the end.
  std::optional<Stop> next();

 private:
  Stop sample() const;
  Stop synchronization() const;

  double sample_every_;
  double checkpoint_every_;
  std::uint32_t particles_;
  std::int64_t samples_;
  std::int64_t last_synchronization_;
  std::int64_t next_sample_ = 0;
  std::int64_t next_synchronization_ = 1;
};

}  // namespace haff::campaign
