// SPDX-License-Identifier: GPL-3.0-or-later

// The observables msd and vacf: displacements and velocities compared with those of waiting times.
//
// The engine keeps particles in the box. To follow them through its faces, the gas is looked at so
// often that no particle covers more than a quarter of the box between two looks. The image that a
// particle has reached is the one nearest to where its velocities before and after would have taken
// it. How often the gas is looked at does not change the result: only positions and whole numbers
// of boxes are kept. Where collisions are so rare that particles move further from one to the next,
// the gas is looked at after each; the places of the two partners are then uncertain by what their
// change of velocity makes of them.
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

  // Begins at this state, from which `gas` starts, with the earlier looks and waiting times that it
  // holds.
  void begin(const engine::Simulation& gas, const engine::State& state);

  // The number of collisions at which the gas must be looked at. Without msd and vacf never.
  std::int64_t next_look() const { return next_look_; }

  // Throws engine::PhysicsError if a particle came further than the gas was expected to move.
  void look(const engine::Simulation& gas);

  // A point of each curve whose waiting time has come: of the profiles msd, diffusion and vacf,
  // where tau is the waiting time and x counts the collisions per particle since. Begins the curves
  // whose waiting time is now.
  std::vector<schema::Profile> sample(const engine::Simulation& gas, double tau);

  // Writes into the memory of a state that is stored, at a synchronization; the engine ignores it.
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
