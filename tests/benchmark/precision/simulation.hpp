// engine::Simulation in single precision: smooth spheres of constant restitution.
#pragma once
#include <cstring>
#include <memory>

#include "engine/simulation.hpp"
#include "engine/state.hpp"

namespace haff::single {
struct Gas;
class Simulation {
 public:
  Simulation(double e, const engine::State& start);
  ~Simulation();
  void run_to(std::int64_t collisions);
  double time() const;
  int exponent() const;
  std::vector<engine::Vector> velocities() const;
  std::vector<engine::Vector> positions() const;
  engine::Tally take_tally();
  engine::Invariants invariants() const;
  engine::Events events() const;
  double latest() const;
  std::size_t memory() const;
  double energy() const;

 private:
  void begin_period();
  void synchronize();
  std::unique_ptr<Gas> gas_;
  double e_;
  std::int64_t next_stop_ = 0;
};
}  // namespace haff::single
