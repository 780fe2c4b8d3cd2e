// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/state/model.hpp"

#include <algorithm>

namespace haff::campaign {

engine::Model model_of(const schema::Job& job) {
  engine::Model model{.restitution = job.e.value_or(1), .seed = job.seed};
  model.law.name = job.effects.law();
  for (const auto& [effect, parameters] : job.effects.by_name())
    (effect == "restitution" ? model.law.parameters : model.effects[effect]) = parameters;
  model.counts_collisions =
      std::ranges::find(job.observables, "collision_statistics") != job.observables.end();
  return model;
}

std::optional<engine::Mixture> mixture_of(const schema::Job& job) {
  const auto asked = job.effects.by_name().find("mixture");
  if (asked == job.effects.by_name().end()) return std::nullopt;
  return engine::mixture_of(asked->second, job.particles);
}

}  // namespace haff::campaign
