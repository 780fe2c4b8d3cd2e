#include "campaign/state/model.hpp"

#include <nlohmann/json.hpp>

namespace haff::campaign {

engine::Model model_of(const schema::Job& job) {
  engine::Model model{.restitution = job.e.value_or(1), .seed = job.seed};
  const auto effects = nlohmann::json::parse(job.effects);
  for (const auto& [effect, asked] : effects.items()) {
    const bool is_law = effect == "restitution";
    engine::Parameters& parameters = is_law ? model.law.parameters : model.effects[effect];
    for (const auto& [key, value] : asked.items()) {
      if (is_law && key == "law")
        model.law.name = value.get<std::string>();
      else
        parameters[key] = value.get<double>();
    }
  }
  return model;
}

std::optional<engine::Mixture> mixture_of(const schema::Job& job) {
  const engine::Model model = model_of(job);
  const auto asked = model.effects.find("mixture");
  if (asked == model.effects.end()) return std::nullopt;
  return engine::mixture_of(asked->second, job.particles);
}

}  // namespace haff::campaign
