// SPDX-License-Identifier: GPL-3.0-or-later

// Where on the tau axis a cooling job stops: to sample, and to store its state.
//
// Samples fall on tau = k sample_every, and on the moments of sample_at; one of these that is the
// same collision as another sample is left out. The engine synchronizes at multiples of its period,
// and only there can a state be stored: at the first synchronization at or after each multiple of
// checkpoint_every, and at the last one before the end, from which a longer run would go on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "schema/grid/job.hpp"

namespace haff::campaign {

// Snapshots wait for the next synchronization to be stored with what it stores; more than this do
// not. [bytes]
inline constexpr std::size_t most_waiting_snapshots = std::size_t{64} << 20;

// The number of samples at this interval to tau_max, that at tau = 0 included. A sample that
// rounding puts just above tau_max (3 x 0.1 > 0.3) is one of them.
std::int64_t sample_count(double sample_every, double tau_max);

// The number of all samples of a job. Walks through those of sample_at.
std::int64_t sample_count(const schema::Job& job, double tau_max);

// How many of these moments are not after tau_max.
std::int64_t count_through(const schema::Moments& moments, double tau_max);

// tau of sample k, the same bits everywhere.
double sample_tau(double sample_every, std::int64_t k);

// tau of a job's samples one after the other, without end.
class SampleTaus {
 public:
  explicit SampleTaus(const schema::Job& job);

  double tau() const { return is_listed() ? listed_ : at_interval(); }
  bool is_listed() const { return listed_ < at_interval(); }  // of sample_at
  std::int64_t at_intervals_before() const { return next_; }
  void advance();

 private:
  double at_interval() const { return sample_tau(sample_every_, next_); }
  void find_listed(double after);

  const schema::Moments moments_;
  double sample_every_;
  std::uint32_t particles_;
  std::int64_t next_ = 0;
  double listed_ = 0;
};

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
  enum class Due { sample, snapshot, synchronization };

  Due due = Due::sample;
  double tau = 0;
  std::int64_t collisions = 0;
  bool keep = false;  // a synchronization whose state is stored in any case
};

class Timetable {
 public:
  // All stops of the job up to tau_max, in the order of collisions, samples first, then snapshots.
  Timetable(const schema::Job& job, double tau_max, double checkpoint_every);

  // Leaves out the stops that lie before a state stored after this many collisions.
  void skip_through(std::int64_t collisions);

  // The next stop; nothing at the end.
  std::optional<Stop> next();

 private:
  std::optional<Stop> sample() const;
  std::optional<Stop> snapshot() const;
  std::optional<Stop> synchronization() const;
  std::optional<Stop> first() const;
  void pass(const Stop& stop);

  SampleTaus taus_;
  const schema::Moments snapshots_at_;
  double end_;  // the last moment of sample_at or snapshots_at may be there
  double checkpoint_every_;
  std::uint32_t particles_;
  std::int64_t samples_at_intervals_;
  double snapshot_;  // the next
  std::int64_t last_synchronization_;
  std::int64_t next_synchronization_ = 1;
};

}  // namespace haff::campaign
