// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/curves/answer/caption.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "campaign/curves/answer/gas_names.hpp"
#include "campaign/curves/labels.hpp"

namespace haff::campaign {
namespace {

std::string realizations_text(const std::vector<GasCurve>& curves, bool is_difference) {
  std::int64_t most = 0, fewest = curves.front().points.front().realizations;
  for (const GasCurve& curve : curves) {
    most = std::max(most, curve.most_realizations());
    fewest = std::min(fewest, curve.fewest_realizations());
  }
  const std::string what = is_difference ? "pairs of realizations" : "realizations";
  if (most == 1) return "one realization each";
  return fewest == most ? fmt::format("means of {} {}", most, what)
                        : fmt::format("means of {} to {} {}", fewest, most, what);
}

}  // namespace

std::string caption_of(const Question& question, const Topic& topic, const GasCurves& curves,
                       const std::vector<std::string>& names, const std::string& tone) {
  std::string common;
  for (const auto& [name, value] : curves.all.front().scene.parameters) {
    const bool usual = name == "equilibrate" || name == "sample_every";
    if (usual || std::ranges::find(names, name) != names.end()) continue;
    common += fmt::format("{} = {}, ", word_for(name, topic.x), number_of(name, value));
  }
  const bool is_difference = question.difference.has_value();
  const std::string sentence = realizations_text(curves.all, is_difference);
  std::string text;
  if (topic.kind == Topic::Kind::quantity) text += describe(topic.quantity) + "; ";
  if (topic.window && topic.window->first == topic.window->second)
    text += fmt::format("at tau {:g}; ", topic.window->first);
  else if (topic.window)
    text += fmt::format("means over tau {:g} to {:g}; ", topic.window->first, topic.window->second);
  text += common + sentence + ".";
  // With a scale of tones the legend does not say what else sets curves apart.
  std::string rest;
  for (const std::string& name : names)
    if (name != tone)
      rest += fmt::format("{}{}", rest.empty() ? "" : ", ", word_for(name, topic.x));
  if (!tone.empty() && !rest.empty())
    text += fmt::format(" Curves of one tone differ in {}.", rest);
  if (is_difference)
    text += fmt::format(" Less what the gas with {} = {} has, seed by seed.",
                        question.difference->first, question.difference->second);
  const bool any_error = std::ranges::any_of(
      curves.all, [](const GasCurve& each) { return each.most_realizations() > 1; });
  if (any_error) text += " Errors: 68 % intervals of the mean (Student's t).";
  if (topic.kind == Topic::Kind::series && any_error) text += " Neighbouring τ are correlated.";
  if (!curves.code_versions.empty())
    text += fmt::format(" haff {}.", fmt::join(curves.code_versions, ", "));
  return text;
}

std::string y_label(const Question& question, const Topic& topic) {
  std::string text = axis_label(topic.y);
  if (!question.difference) return text;
  const auto& [name, value] = *question.difference;
  return text + ", less that at " + symbol(name) + " = " + literal(value);
}

}  // namespace haff::campaign
