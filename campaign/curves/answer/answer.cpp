// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/curves/answer/answer.hpp"

#include <cstddef>
#include <utility>

#include "campaign/curves/answer/caption.hpp"
#include "campaign/curves/answer/frame.hpp"
#include "campaign/curves/answer/gas_names.hpp"
#include "campaign/curves/answer/styles.hpp"
#include "campaign/curves/answer/theory.hpp"
#include "campaign/curves/gas_curves.hpp"
#include "campaign/curves/labels.hpp"

namespace haff::campaign {
namespace {

// More points than this on a curve are drawn as a line with a band.
constexpr std::size_t many_points = 30;

Curve measured(const GasCurve& gas, const std::vector<std::string>& names,
               const std::string& variable) {
  Curve curve{.name = label_of(gas.scene, names, false, variable),
              .legend = label_of(gas.scene, names, true, variable),
              .source = Source::measured,
              .e = gas.scene.number("e"),
              .n = gas.scene.number("n")};
  if (const auto particles = gas.scene.number("N"))
    curve.particles = static_cast<std::int64_t>(*particles);
  for (const auto& [name, value] : gas.scene.parameters)
    if (name != "e" && name != "n" && name != "N")
      curve.parameters.emplace_back(name, value_text(value));
  for (const CurvePoint& point : gas.points) {
    curve.x.push_back(point.x);
    curve.y.push_back(point.y);
    curve.error.push_back(point.error);
    curve.realizations.push_back(point.realizations);
  }
  return curve;
}

}  // namespace

Answer answer(const schema::Reader& store, const Question& question) {
  const Vocabulary words = vocabulary_of(store);
  const Topic topic = topic_of(question, words);
  GasCurves curves = gas_curves(store, words, topic, question);
  const auto names = names_for(question, curves.all);
  sort_by(names, curves.all);

  Panel panel{
      .x = {.label = axis_label(topic.x), .column = topic.x, .logarithmic = question.log_x},
      .y = {
          .label = y_label(question, topic), .column = question.y, .logarithmic = question.log_y}};
  const bool crowded = curves.all.size() > most_in_legend;
  const bool has_theory = question.theory && curves.all.size() <= question.theory_up_to;
  Styles styles(question, curves.all, names, topic.x);
  panel.scale = styles.scale();
  for (const GasCurve& gas : curves.all) {
    Curve curve = measured(gas, names, topic.x);
    const bool is_line =
        is_along_runs(topic) && !has_theory && (crowded || curve.x.size() > many_points);
    curve.look = is_line ? Look::line : Look::symbols;
    curve.joined = !has_theory && !is_line;
    styles.apply(gas, curve);
    if (panel.scale || curves.all.size() == 1) curve.legend.clear();
    panel.curves.push_back(std::move(curve));
  }
  check_logarithmic(panel);
  Answer result{.plot = {}, .notes = std::move(curves.notes)};
  if (has_theory) add_theory(topic, curves.all, panel, result.notes);
  set_ranges(panel, curves.all.size());
  const int width = place_legend(panel);
  const std::string of_theory = contact_value_note(panel);
  result.plot = {.panels = {std::move(panel)},
                 .caption = caption_of(question, topic, curves, names, styles.tone()) + of_theory,
                 .width = width};
  return result;
}

}  // namespace haff::campaign
