// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/curves/answer/styles.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "campaign/curves/answer/gas_names.hpp"
#include "campaign/curves/labels.hpp"
#include "campaign/plot/colours.hpp"

namespace haff::campaign {
namespace {

// The parameter that colours go by: the one asked for, or the number with the most values.
std::string primary(const Question& question, const std::vector<GasCurve>& curves,
                    const std::vector<std::string>& names) {
  if (!question.by.empty()) return question.by.front();
  std::string best;
  std::size_t most = 0;
  for (const std::string& name : names) {
    std::set<double> values;
    for (const GasCurve& curve : curves)
      if (const auto value = curve.scene.number(name)) values.insert(*value);
    if (values.size() > most) {
      most = values.size();
      best = name;
    }
  }
  return best;
}

// Of all curves, if each has a number of this name and they are many.
std::optional<ToneScale> tone_scale(const std::vector<GasCurve>& curves, const std::string& name,
                                    const std::string& variable) {
  constexpr double wide = 30;  // a range beyond this factor is shown in logarithms
  if (curves.size() <= most_in_legend) return std::nullopt;
  ToneScale scale{.label = axis_label(word_for(name, variable))};
  std::set<double> values;
  for (const GasCurve& curve : curves) {
    const auto value = curve.scene.number(name);
    if (!value) return std::nullopt;
    values.insert(*value);
  }
  if (values.size() < 3) return std::nullopt;
  scale.low = *values.begin();
  scale.high = *values.rbegin();
  scale.logarithmic = scale.low > 0 && scale.high > wide * scale.low;
  return scale;
}

}  // namespace

Styles::Styles(const Question& question, const std::vector<GasCurve>& curves,
               const std::vector<std::string>& names, const std::string& variable)
    : by_(question.by.empty() ? names : question.by), primary_(primary(question, curves, names)) {
  scale_ = tone_scale(curves, primary_, variable);
  for (const GasCurve& curve : curves) {
    const std::string group = label_of(curve.scene, by_, false);
    if (std::ranges::find(groups_, group) == groups_.end()) groups_.push_back(group);
  }
}

void Styles::apply(const GasCurve& gas, Curve& curve) {
  constexpr std::array symbols{7, 5, 9, 13, 11, 6, 4, 8, 12, 10};  // gnuplot's, filled first
  const std::string group = label_of(gas.scene, by_, false);
  const auto place = static_cast<std::size_t>(std::ranges::find(groups_, group) - groups_.begin());
  curve.colour =
      scale_ ? scale_->tone(gas.scene.number(primary_).value()) : colour(place, groups_.size());
  const std::size_t twin = seen_[group]++;
  curve.symbol = symbols[twin % symbols.size()];
  if (curve.look != Look::symbols && twin > 0) {
    constexpr std::array looks{Look::dashed, Look::dotted, Look::dash_dotted};
    curve.look = looks[(twin - 1) % looks.size()];
  }
}

}  // namespace haff::campaign
