// Actions: effects that change velocities between collisions, at numbers of collisions of their
// own.
//
// Each is a class in a file of its own:
//
//   class SomeAction : public Action {
//    public:
//     static constexpr std::string_view name = "some";            // its name in a grid
//     SomeAction(const Parameters& parameters, std::uint64_t seed, const State& start);
//     std::int64_t next(std::int64_t collisions, std::size_t particles) const override;
//     void act(std::span<Particle> particles, const Clock& clock) override;
//   };
//
// and a line in the list below. They work where the gas is synchronized (every action adds
// synchronizations of its own), so the event loop knows nothing of them and is compiled once for
// all.
#pragma once

#include <memory>
#include <string_view>
#include <tuple>
#include <vector>

#include "engine/shuffle.hpp"
#include "engine/thermostat.hpp"

namespace haff::engine {

using Actions = std::tuple<Shuffle, Thermostat>;

bool is_action(std::string_view name);

// Those that the model asks for, in the order of the list, in which they are also done.
std::vector<std::unique_ptr<Action>> actions_of(const Model& model, const State& start);

// Does those that are due. Whether there was one: the clock then starts anew from its velocities.
bool act(const std::vector<std::unique_ptr<Action>>& actions, std::span<Particle> particles,
         const Clock& clock);

}  // namespace haff::engine
