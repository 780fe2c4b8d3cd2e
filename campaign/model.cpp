#include "campaign/model.hpp"

#include <nlohmann/json.hpp>

namespace haff::campaign {

engine::Model model_of(const schema::Job& job) {
  engine::Model model{.restitution = job.e};
  const auto effects = nlohmann::json::parse(job.effects);
  if (!effects.contains("restitution")) return model;
  for (const auto& [key, value] : effects["restitution"].items()) {
    if (key == "law")
      model.law.name = value.get<std::string>();
    else
      model.law.parameters[key] = value.get<double>();
  }
  return model;
}

}  // namespace haff::campaign
