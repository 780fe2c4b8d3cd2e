// SPDX-License-Identifier: GPL-3.0-or-later

// The observables msd and vacf: displacements and velocities compared with those of waiting times.
//
// The engine keeps particles in the box. To follow one through its faces, the gas is looked at so
// often that a particle comes a quarter of the box at most between two looks, and the image that it
// has reached is the one nearest to where its velocities before and after would have taken it. How
// often that is decides nothing: what is kept are positions, and whole numbers of boxes. Where
// collisions are so rare that the gas moves further from one to the next, it is looked at after
// each; the two particles that collided are then known to within what their change of velocity
// does.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/simulation.hpp"
#include "schema/grid/job.hpp"
#include "schema/rows/measured.hpp"

namespace haff::campaign {

class Diffusion {
 public:
  explicit Diffusion(const schema::Job& job);

  // From this state on, with what it holds of earlier looks and waiting times. `gas` starts from
  // it.
  void begin(const engine::Simulation& gas, const engine::State& state);

  // The number of collisions at which the gas must be looked at. Without msd and vacf never.
  std::int64_t next_look() const { return next_look_; }

  // Throws engine::PhysicsError if a particle came further than the gas was expected to move.
  void look(const engine::Simulation& gas);

  // A point of each curve whose waiting time has come: of the profiles msd, diffusion and vacf,
  // whose tau is the waiting time, and x the collisions per particle since. Begins those whose
  // waiting time is now.
  std::vector<schema::Profile> sample(const engine::Simulation& gas, double tau);

  // Into the memory of a state that is stored, at a synchronization; the engine passes it by.
  void store(engine::State& state) const;

 private:
  using Vectors = std::vector<engine::Vector>;  // by id

  // What is compared with. Nothing before the waiting time.
  struct Waiting {
    double tau = 0;
    bool msd = false, vacf = false;
    Vectors position, velocity;         // not wrapped; in true units
    double last_lag = 0, last_msd = 0;  // of the sample before
  };

  Vectors by_id(const Vectors& values, const engine::Simulation& gas, int exponent) const;
  Vectors unwrapped() const;
  std::int64_t collisions_ahead(double fastest) const;
  double expected_rate() const;

  const schema::Job& job_;
  double box_;
  std::vector<Waiting> waiting_;
  Vectors position_, velocity_;  // at the last look
  Vectors images_;               // boxes that each particle has left behind, whole numbers
  double time_ = 0;
  std::int64_t collisions_ = 0;
  double rate_ = 0;  // collisions in a unit of time
  std::int64_t next_look_ = 0;
};

}  // namespace haff::campaign
