// SPDX-License-Identifier: GPL-3.0-or-later

// The choices made once per simulation: the search and the physics of a collision. Each combination
// is compiled as an event loop of its own; this is their common interface.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string_view>

#include "engine/loop/gas.hpp"
#include "engine/simulation.hpp"

namespace haff::engine {

class EngineVariant {
 public:
  virtual ~EngineVariant() = default;
  virtual void run(Gas& gas, std::int64_t collisions, double end) = 0;
  virtual void predict_all(Gas& gas) = 0;
  // See synchronize.hpp.
  virtual void start(Gas& gas) = 0;
  virtual void audit(Gas& gas, double allowed_overlap) = 0;
  virtual void synchronize(Gas& gas) = 0;
  // The memory of the physics: see Memoryless.
  virtual void store(State& state) const = 0;
  virtual void scale(int exponent) = 0;
  virtual std::optional<Rotation> rotation() const = 0;
  // Counts of the work of several threads, if the variant has them.
  virtual std::optional<Windows> windows() const { return std::nullopt; }
  // The counts in bins since the last call, if the variant counts collisions.
  virtual std::optional<CollisionCounts> take_collision_counts() = 0;
  virtual std::size_t memory() const = 0;  // bytes, in addition to the gas
};

// The variant without SIMD, for boxes in which a particle can meet several images of another one,
// and for comparison. Throws std::invalid_argument if there is no such restitution model.
std::unique_ptr<EngineVariant> plain_variant(const Model& model, const State& start);

// Smooth equal spheres, with SIMD. Throws likewise.
std::unique_ptr<EngineVariant> spheres_variant(const Model& model, const Gas& gas,
                                               const State& start);

// Any physics, on several threads. Throws likewise.
std::unique_ptr<EngineVariant> parallel_variant(const Model& model, const State& start,
                                                const Threads& threads);
std::unique_ptr<EngineVariant> parallel_mixture(const Model& model, const State& start,
                                                const Threads& threads);

// Any physics, with its collisions counted. Throws likewise.
std::unique_ptr<EngineVariant> observed_variant(const Model& model, const Gas& gas,
                                                const State& start, SearchBackend backend);

// Disks, with SIMD. Throws likewise.
std::unique_ptr<EngineVariant> disks_variant(const Model& model, const State& start);

// Physics other than that of smooth spheres, by the effect that asks for it, with any restitution
// model. Throws std::invalid_argument if a parameter is missing or the state does not fit.
struct OtherPhysics {
  std::string_view effect;
  std::unique_ptr<EngineVariant> (*make)(const Model&, const Gas&, const State&, SearchBackend);
};

std::unique_ptr<EngineVariant> rough_variant(const Model& model, const Gas& gas, const State& start,
                                             SearchBackend backend);
std::unique_ptr<EngineVariant> mixture_variant(const Model& model, const Gas& gas,
                                               const State& start, SearchBackend backend);

inline constexpr std::array<OtherPhysics, 2> other_physics{{
    {"roughness", rough_variant},
    {"mixture", mixture_variant},
}};

}  // namespace haff::engine
