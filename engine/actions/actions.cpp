// SPDX-License-Identifier: GPL-3.0-or-later

#include "engine/actions/actions.hpp"

namespace haff::engine {
namespace {

template <class Visit>
void for_each_action(Visit&& visit) {
  [&]<class... Each>(const std::tuple<Each...>*) {
    (visit(static_cast<const Each*>(nullptr)), ...);
  }(static_cast<const Actions*>(nullptr));
}

}  // namespace

bool is_action(std::string_view name) {
  bool found = false;
  for_each_action([&]<class Each>(const Each*) { found = found || Each::name == name; });
  return found;
}

std::vector<std::unique_ptr<Action>> actions_of(const Model& model, const State& start) {
  std::vector<std::unique_ptr<Action>> actions;
  for_each_action([&]<class Each>(const Each*) {
    const auto asked = model.effects.find(std::string(Each::name));
    if (asked != model.effects.end())
      actions.push_back(std::make_unique<Each>(asked->second, model.seed, start));
  });
  return actions;
}

bool act(const std::vector<std::unique_ptr<Action>>& actions, std::span<Particle> particles,
         const Clock& clock) {
  bool any = false;
  for (const auto& action : actions)
    if (action->is_due(clock.collisions, particles.size())) {
      action->act(particles, clock);
      any = true;
    }
  return any;
}

}  // namespace haff::engine
