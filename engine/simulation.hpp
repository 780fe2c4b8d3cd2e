// The simulation of one gas: give it a state, let it collide, look at it, take the state back.
//
//   Simulation gas({.restitution = 0.8}, state);
//   gas.run_to(collisions_at(tau, N));
//
// The trajectory depends on the state and the model alone: not on how run_to() was called, on
// the SIMD width, or on the size of cells. Stopping at a synchronization, storing state() and
// starting again from it continues the same trajectory bit for bit.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "engine/state.hpp"

namespace haff::engine {

using Parameters = std::map<std::string, double>;

// How the restitution coefficient depends on the collision: a law of laws.hpp by its name, with
// its parameters, e.g. {"tc", {{"t_c", 1e-4}}}.
struct RestitutionLaw {
  std::string name = "constant";
  Parameters parameters = {};
};

struct Model {
  double restitution = 1;  // e, normal
  RestitutionLaw law = {};
  // What else a scene asks for, by its name with its parameters: {{"shuffle", {{"every", 1}}}}.
  std::map<std::string, Parameters> effects = {};
  std::uint64_t seed = 0;  // of the random numbers that effects draw
};

// Which implementation looks for contacts. All give the same bits.
enum class Prediction { simd, scalar };

// What happened, by kind. Speed is the price of these; the trajectory is made by collisions alone.
struct Events {
  std::int64_t collisions = 0;
  std::int64_t crossings = 0;  // a particle entered another cell
  std::int64_t stale = 0;      // the expected partner had collided meanwhile: looked again
};

// The physics has broken: overlap, NaN, time running backwards. The message says where.
struct Breakdown : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Inelastic collapse: some particles collide infinitely often within a finite time (watchdog.hpp).
// Not an error of the simulation, but the end of what constant restitution can say.
struct Collapse : std::runtime_error {
  Collapse(const std::string& message, std::vector<std::uint32_t> ids, const Vector& at,
           std::int64_t collision)
      : std::runtime_error(message), particles(std::move(ids)), place(at), collisions(collision) {}

  std::vector<std::uint32_t> particles;  // ids, sorted
  Vector place;                          // of one of them, in [0, L)
  std::int64_t collisions;               // when it was noticed
};

// Pair collisions after which tau (collisions per particle) is reached: ceil(tau N / 2).
std::int64_t collisions_at(double tau, std::uint32_t particles);

// The gas is synchronized whenever tau is a multiple of this (and wherever an effect acts on it
// between collisions), and only there can it be stopped and stored. Part of the trajectory's
// definition: changing it changes bits. [collisions/particle]
inline constexpr double synchronization_period = 10;

class Simulation {
 public:
  // Throws Breakdown if the state is none of hard spheres (soundness.hpp), std::invalid_argument if
  // there is no such law or effect, or a parameter of it is missing.
  Simulation(const Model& model, const State& start, Prediction prediction = Prediction::simd);
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  // Go on until exactly so many pair collisions have happened in all, synchronizing on the way
  // whenever that is due. Throws Breakdown or Collapse; after that the gas can only be looked at.
  void run_to(std::int64_t collisions);

  std::uint32_t particles() const;
  std::int64_t collisions() const;
  double time() const;        // true time of the last event
  bool synchronized() const;  // may state() be called?

  // Scaled velocities, true velocity = velocity * 2^-exponent, in an order that depends on the
  // trajectory alone. Positions at time(), in [0, L), in the same order.
  std::vector<Vector> velocities() const;
  std::vector<Vector> positions() const;
  std::vector<std::uint32_t> ids() const;  // in the same order
  int exponent() const;

  // Kinetic energy of rotation per particle, scaled as velocity squared; nothing if spheres do not
  // rotate.
  std::optional<double> rotational_energy() const;

  // What collisions did since the last call.
  Tally take_tally();
  Invariants invariants() const;

  // The state, only at a synchronization (throws std::logic_error elsewhere).
  State state() const;

  Events events() const;       // since the simulation was made
  std::size_t memory() const;  // bytes held

 private:
  class Implementation;
  std::unique_ptr<Implementation> self_;
};

// Name of the SIMD instruction set in use, e.g. "AVX2".
std::string simd_target();

}  // namespace haff::engine
