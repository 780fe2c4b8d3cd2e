// SPDX-License-Identifier: GPL-3.0-or-later

// The simulation of one gas: it starts from a state, runs, can be observed, and returns its state.
//
//   Simulation gas({.restitution = 0.8}, state);
//   gas.run_to(collisions_at(tau, N));
//
// The trajectory depends only on the state and the model, not on how run_to() was called, on the
// SIMD width, or on the size of the cells. A run that is stopped at a synchronization and started
// again from its state() continues the same trajectory bit for bit.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "collision_counts.hpp"
#include "state.hpp"

namespace haff::engine {

// The version of the bits that the engine computes, which checkpoints and jobs carry. Any change of
// a trajectory raises it; tests/engine/golden_states.cpp holds the hashes of the present version.
inline constexpr int physics_version = 1;

using Parameters = std::map<std::string, double>;

// How the restitution coefficient depends on the collision: a model in
// restitution/restitution_models.hpp by its name, with its parameters, for example
// {"tc", {{"t_c", 1e-4}}}.
struct RestitutionLaw {
  std::string name = "constant";
  Parameters parameters = {};
};

struct Model {
  double restitution = 1;  // e, normal
  RestitutionLaw law = {};
  // Further effects by name, with their parameters: {{"shuffle", {{"every", 1}}}}.
  std::map<std::string, Parameters> effects = {};
  std::uint64_t seed = 0;  // of the random numbers of effects
  // Whether collisions are counted in bins. The trajectory keeps its bits; one thread computes it.
  bool counts_collisions = false;
};

// The implementation that searches for contacts. All give the same bits.
enum class SearchBackend { simd, scalar };

// The threads that a simulation runs on. Every number gives the same bits.
struct Threads {
  unsigned count = 1;
  // Into how many slabs the box is divided, at least one for each thread; 0: as many as threads.
  unsigned slabs = 0;
  // The length of a window [collisions per particle], within which the threads do not wait for each
  // other; 0: adapted to the gas. Tests set it.
  double window = 0;
};

// Counts of the work of several threads.
struct Windows {
  std::int64_t count = 0;
  std::int64_t repaired = 0;      // undone and repeated in one piece
  std::int64_t in_one_piece = 0;  // collisions
  // Events of windows that were not repaired, by the phase in which they were processed.
  std::int64_t in_slabs = 0;
  std::int64_t in_zones = 0;
  // The events of the busiest thread in every phase of a window, summed.
  std::int64_t longest = 0;
};

// The number of events by kind. They determine the cost; collisions alone determine the trajectory.
struct Events {
  std::int64_t collisions = 0;
  std::int64_t crossings = 0;  // a particle entered another cell
  std::int64_t stale = 0;      // the expected partner had collided meanwhile: a new search
};

// The simulation has become physically impossible: an overlap, a NaN, a violated conservation law.
// The message says what and where.
struct PhysicsError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Inelastic collapse: some particles collide infinitely often within a finite time
// (loop/watchdog.hpp). This is not an error of the simulation: a gas of constant restitution has no
// continuation here.
struct Collapse : std::runtime_error {
  Collapse(const std::string& message, std::vector<std::uint32_t> ids, const Vector& at,
           std::int64_t collision)
      : std::runtime_error(message), particles(std::move(ids)), place(at), collisions(collision) {}

  std::vector<std::uint32_t> particles;  // ids, sorted
  Vector place;                          // of one of them, in [0, L)
  std::int64_t collisions;               // so far, when it was noticed
};

// The number of pair collisions after which tau (collisions per particle) is reached:
// ceil(tau N / 2).
std::int64_t collisions_at(double tau, std::uint32_t particles);

// The gas is synchronized whenever tau is a multiple of this (and whenever an action is due); only
// then can its state be stored. The period is part of the definition of a trajectory: changing it
// changes bits. [collisions/particle]
inline constexpr double synchronization_period = 10;

class Simulation {
 public:
  // Throws std::invalid_argument if the state is not one of hard spheres (soundness.hpp), if there
  // is no such restitution model or effect, or if one of its parameters is missing.
  Simulation(const Model& model, const State& start, SearchBackend backend = SearchBackend::simd,
             const Threads& threads = {});
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  // Runs until exactly this many pair collisions have happened in total, and synchronizes on the
  // way whenever that is due. Throws PhysicsError or Collapse; after that the gas can only be
  // observed.
  void run_to(std::int64_t collisions);

  // The same, but not beyond this true time. Returns true if the run stops there, between two
  // collisions: fewer collisions have happened, and positions() are those of that moment. The
  // trajectory is the same wherever a run stops. A time that has already passed means now.
  bool run_to(std::int64_t collisions, double time);

  std::uint32_t particles() const;
  std::int64_t collisions() const;
  double time() const;        // the true time of the last event, or at which a run has stopped
  bool synchronized() const;  // whether state() may be called

  // Scaled velocities (true velocity = velocity * 2^-exponent), in an order that depends on the
  // trajectory alone; positions at time(), in [0, L), and ids in the same order.
  std::vector<Vector> velocities() const;
  std::vector<Vector> positions() const;
  std::vector<std::uint32_t> ids() const;
  int exponent() const;

  // Kinetic energy of rotation per particle, scaled like a squared velocity; nothing if particles
  // do not rotate.
  std::optional<double> rotational_energy() const;

  // The tally of collisions since the last call.
  Tally take_tally();
  Invariants invariants() const;

  // The statistics of collisions since the last call, in bins; nothing unless the model asks for
  // them.
  std::optional<CollisionCounts> take_collision_counts();

  // The state; throws std::logic_error if the gas is not synchronized.
  State state() const;

  // The gas as it is at time(), synchronized or not, to be looked at: positions, velocities,
  // species and spins. It has no memory and no tally, so a trajectory cannot go on from it.
  State snapshot() const;

  Events events() const;                   // since the simulation was made
  std::optional<Windows> windows() const;  // nothing if it runs on one thread
  std::size_t memory() const;              // bytes held

 private:
  class Implementation;
  std::unique_ptr<Implementation> self_;
};

// The name of the SIMD instruction set in use, for example "AVX2".
std::string simd_target();

}  // namespace haff::engine
