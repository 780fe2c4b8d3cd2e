// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/curves/scene.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "campaign/base/text/number_text.hpp"

namespace haff::campaign {
namespace {

bool belongs(std::string_view parameter, std::string_view but) {
  return parameter == but || (!but.empty() && effect_of(parameter) == but);
}

}  // namespace

std::string value_text(const ParameterValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  return number_text(std::get<double>(value));
}

const ParameterValue* Scene::find(std::string_view name) const {
  const auto found =
      std::ranges::find(parameters, name, [](const auto& each) { return each.first; });
  return found == parameters.end() ? nullptr : &found->second;
}

std::optional<double> Scene::number(std::string_view name) const {
  const ParameterValue* value = find(name);
  if (value == nullptr || !std::holds_alternative<double>(*value)) return std::nullopt;
  return std::get<double>(*value);
}

Scene scene_of(const schema::Job& job) {
  Scene scene{.job = job, .parameters = {}};
  const auto add = [&](std::string name, ParameterValue value) {
    scene.parameters.emplace_back(std::move(name), std::move(value));
  };
  add("d", static_cast<double>(job.d));
  if (job.e) add("e", *job.e);
  add("n", job.n);
  add("N", static_cast<double>(job.particles));
  add("equilibrate", job.equilibrate);
  add("sample_every", job.sample_every);
  if (!job.start.is_uniform()) add("start", schema::start_text(job.start));
  if (!job.sample_at.empty()) add("sample_at", schema::schedule_text(job.sample_at));
  for (const auto& [effect, parameters] : job.effects.by_name()) {
    if (effect == "restitution") add("restitution.law", job.effects.law());
    for (const auto& [name, value] : parameters) add(fmt::format("{}.{}", effect, name), value);
  }
  return scene;
}

std::string effect_of(std::string_view parameter) {
  const auto dot = parameter.find('.');
  return dot == std::string_view::npos ? std::string() : std::string(parameter.substr(0, dot));
}

bool agree(const Scene& one, const Scene& other, std::string_view but) {
  const auto covers = [&](const Scene& a, const Scene& b) {
    return std::ranges::all_of(a.parameters, [&](const auto& each) {
      if (belongs(each.first, but)) return true;
      const ParameterValue* value = b.find(each.first);
      return value != nullptr && *value == each.second;
    });
  };
  return covers(one, other) && covers(other, one);
}

std::vector<std::string> varying(const std::vector<const Scene*>& scenes) {
  std::vector<std::string> names;
  for (const Scene* scene : scenes)
    for (const auto& [name, value] : scene->parameters) {
      if (std::ranges::find(names, name) != names.end()) continue;
      const bool same = std::ranges::all_of(scenes, [&, &name = name, &value = value](auto* other) {
        const ParameterValue* its = other->find(name);
        return its != nullptr && *its == value;
      });
      if (!same) names.push_back(name);
    }
  return names;
}

}  // namespace haff::campaign
