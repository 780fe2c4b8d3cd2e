// SPDX-License-Identifier: GPL-3.0-or-later

// Actions: effects that change velocities between collisions, at collision numbers of their own.
//
// Each action is a class in a file of its own:
//
//   class SomeAction : public Action {
//    public:
//     static constexpr std::string_view name = "some";            // its name in a grid
//     SomeAction(const Parameters& parameters, std::uint64_t seed, const State& start);
//     std::int64_t next(std::int64_t collisions, std::size_t particles) const override;
//     void act(std::span<Particle> particles, const Clock& clock) override;
//   };
//
// and a name in the list below. The gas is synchronized whenever an action is due, so the event
// loop knows nothing of actions and is not compiled again for them.
#pragma once

#include <memory>
#include <string_view>
#include <tuple>
#include <vector>

#include "engine/actions/shuffle.hpp"
#include "engine/actions/thermostat.hpp"

namespace haff::engine {

using Actions = std::tuple<Shuffle, Thermostat>;

bool is_action(std::string_view name);

// The actions that the model asks for, in the order of the list; they are also done in this order.
std::vector<std::unique_ptr<Action>> actions_of(const Model& model, const State& start);

// Does the actions that are due. Returns whether there was one. If so, the velocities have changed,
// and the clock has to start anew from them.
bool act(const std::vector<std::unique_ptr<Action>>& actions, std::span<Particle> particles,
         const Clock& clock);

}  // namespace haff::engine
