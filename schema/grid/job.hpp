// SPDX-License-Identifier: GPL-3.0-or-later

// What a job is: the physics that defines it, its kind and its status.
//
// Campaign makes jobs out of a grid, the store keeps them; both use the same words as the columns
// of the table jobs (001-store.sql). Units: length sigma, mass m, energy E(0) per particle, time
// sigma sqrt(m/E(0)); tau is collisions suffered per particle.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "schema/grid/effects.hpp"
#include "schema/grid/moments.hpp"
#include "schema/grid/start.hpp"

namespace haff::schema {

// A job either melts and equilibrates an elastic gas (e = 1) or lets an equilibrated one cool.
enum class Kind { equilibration, cooling };

std::string_view name(Kind kind);
Kind kind_named(std::string_view name);  // throws std::invalid_argument

// In this order, everywhere. The table job_status of the store holds the same rows.
enum class Status { pending, running, lent, done, failed, collapsed };

struct StatusEntry {
  Status status;
  std::string_view name;
  std::string_view meaning;
};

inline constexpr std::array<StatusEntry, 6> statuses{{
    {Status::pending, "pending", "waits to be run, or to be gone on with"},
    {Status::running, "running", "a worker holds its lease"},
    {Status::lent, "lent", "a shard holds it; merge or recall brings it home"},
    {Status::done, "done", "reached tau_max; samples and results are complete"},
    {Status::failed, "failed", "gave up after repeated errors; its last error is kept"},
    {Status::collapsed, "collapsed", "ended in inelastic collapse; samples up to then are kept"},
}};

std::string_view name(Status status);
Status status_named(std::string_view name);  // throws std::invalid_argument

// The physics of one job: equal physics is the same job, and gives the same rows bit for bit.
// What changes how far or how conveniently it is computed (tau_max, checkpoint_every, workers,
// the program's version) is not part of it.
struct Job {
  Kind kind = Kind::cooling;
  int d = 3;                    // dimension
  std::optional<double> e = 1;  // normal restitution coefficient; 1 for an equilibration; empty
                                // where the law of restitution has none (viscoelastic)
  double n = 0;                 // number density [sigma^-d]
  std::uint32_t particles = 0;  // N
  std::uint64_t seed = 0;       // realization, 0 ... 2^53 - 1
  Start start = {};             // of an equilibration: how it begins, if there is none to run
  double equilibrate = 50;      // elastic collisions per particle before cooling; 0: none
  double sample_every = 1;      // samples are taken at tau = k sample_every
  Schedule sample_at = {};      // and at these moments
  Effects effects = {};
  std::vector<std::string> observables = {};  // listed in grid.schema.json; in any order
  std::optional<double> profiles_every = {};  // profiles at tau = k profiles_every; empty: none
  std::vector<double> fields_at = {};         // fields at these tau, increasing
  Schedule snapshots_at = {};                 // the whole gas at these moments

  bool operator==(const Job&) const = default;
};

// Samples of an equilibration are taken at this interval, whatever the cooling jobs that start
// from it ask for. [collisions per particle]
inline constexpr double equilibration_sample_every = 10;

// The equilibration a cooling job starts from: the same gas at e = 1, which depends on
// (d, n, particles, seed, equilibrate) and the effects that matter at e = 1. It runs to
// tau_max = equilibrate and measures temperature and laguerre. Where the start is a crystal or a
// file there is nothing to run: the job holds the state, one for all seeds of a file.
Job equilibration_of(const Job& cooling);
double tau_max_of_equilibration(const Job& equilibration);

// The text that names a job: its physics as JSON, keys sorted, no spaces, reals in the shortest
// form that reads back as the same double, observables sorted; profiles_every, fields_at,
// sample_at, snapshots_at and a start that is not uniform are there only in a job that has them.
// The text itself is the identity, not a hash of it: two jobs are the same exactly if their texts
// are equal, a person can read what differs, and the 200 bytes it takes are nothing beside a job's
// samples.
std::string identity(const Job& job);

// Whether Haff's law says how it cools, so that gamma_ratio and tau_c have a meaning: smooth equal
// spheres lose energy by a constant e, and gain none; at the start they do not flow, and are
// nowhere hotter than elsewhere.
bool cools_by_haff(const Job& job);

// The job without what it observes: neither observables nor profiles, fields or snapshots. Jobs
// that have this in common sample the same gas at the same moments.
Job unobserved(Job job);

// Nor when it samples: jobs that have this in common compute the same gas.
Job unsampled(Job job);

// What the realizations of one series have in common: the identity with seed 0.
std::string series_identity(Job job);

// Whether the sample at tau is one of those at equal intervals, not one of sample_at alone.
bool is_at_interval(const Job& job, double tau);

// Whether an observable is taken every profiles_every, at fields_at, or else with every sample.
bool is_profile(std::string_view observable);
bool is_field(std::string_view observable);

// ["laguerre","temperature"]: sorted JSON, as in the column jobs.observables. And back.
std::string observables_text(const std::vector<std::string>& observables);
std::vector<std::string> observables_in(const std::string& text);

// [20,60], as in the column jobs.fields_at. And back.
std::string fields_at_text(const std::vector<double>& fields_at);
std::vector<double> fields_at_in(const std::string& text);

}  // namespace haff::schema
