// SPDX-License-Identifier: GPL-3.0-or-later

// What a job has measured and where it is, as rows of the tables of 001-store.sql and the scripts
// after it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace haff::schema {

// One row of samples; a value that does not exist (first sample, observable not asked for) is
// empty, and NULL in the store. A value that is not finite is refused.
struct Sample {
  double tau = 0;   // k sample_every, or of sample_at [collisions per particle]
  double time = 0;  // true time [sigma sqrt(m/E(0))]
  std::optional<double> temperature = {};     // T = (m/d) <v^2> [E(0)]
  std::optional<double> gamma_ratio = {};     // gamma/gamma_0, middle of the interval before tau
  std::optional<double> collision_rate = {};  // omega [per particle and time], same interval
  std::optional<double> pressure = {};        // [E(0) sigma^-d], same interval
  std::optional<double> a2 = {}, a3 = {}, a4 = {}, a5 = {}, a6 = {};  // Laguerre coefficients
  std::optional<double> correlation_trace = {};  // Tr G^+(0) [E(0)/m], where profiles are taken
  std::optional<double> largest_cluster = {};    // part of the particles, where profiles are taken
  std::optional<double> rotational_temperature =
      {};  // (I/3) <omega^2>, of disks I <omega^2> [E(0)], roughness
  std::optional<double> temperature_1 = {}, temperature_2 = {};  // of each species [E(0)], mixture

  bool operator==(const Sample&) const = default;
};

// A curve at the tau of a sample. Names, x and units: 002-profiles.sql. Values are finite.
struct Profile {
  std::string name;
  double tau = 0;
  std::vector<double> x = {}, value = {};  // x increases

  bool operator==(const Profile&) const = default;
};

// The gas in cells^d cells at the tau of a sample. Names, order of values and units:
// 002-profiles.sql.
struct Field {
  std::string name;
  double tau = 0;
  int cells = 0;  // along each axis
  int components = 1;
  double box = 0;                   // side [sigma]
  std::vector<double> values = {};  // NaN where a cell has none
};

struct FieldName {
  std::string name;
  double tau = 0;
};

struct Results {
  std::optional<double> tau_c = {};   // first tau with T_Haff(tau) = T(tau)/2
  std::optional<double> time_c = {};  // the time of tau_c [sigma sqrt(m/E(0))]

  bool operator==(const Results&) const = default;
};

// A row of invariants: whether the physics of a run held, counted since its start.
struct Invariants {
  double largest_overlap = 0;  // [sigma]
  std::int64_t past_events = 0;
  std::int64_t unresolved_collisions = 0;
  double energy_mismatch = 0;   // relative
  double momentum_removed = 0;  // relative to sqrt(N) rms speeds

  bool operator==(const Invariants&) const = default;
};

// Checkpoints are cut into BLOBs of this size. SQLite holds one whole in memory, and refuses any
// above 1 GB. [bytes]
inline constexpr std::size_t chunk_bytes = std::size_t{16} << 20;

// A state of the engine, encoded by the campaign.
struct Checkpoint {
  double tau = 0;
  std::int64_t collisions = 0;
  std::vector<std::byte> state = {};
};

// The whole gas at one moment of snapshots_at, encoded like a checkpoint. No job goes on from it.
struct Snapshot {
  double tau = 0;   // that of the moment, or 2 C / N of a moment in time
  double time = 0;  // of the gas [sigma sqrt(m/E(0))]
  std::int64_t collisions = 0;
  std::vector<std::byte> state = {};
};

struct SnapshotInfo {
  double tau = 0;
  double time = 0;
  std::int64_t collisions = 0;
  std::int64_t bytes = 0;
};

// How far a job is.
struct Progress {
  double tau = 0;
  std::int64_t collisions = 0;
  double cpu_seconds = 0;  // over all attempts: what the claim said, plus the worker's own
};

}  // namespace haff::schema
