// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/curves/answer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "analysis/direct/table.hpp"
#include "campaign/base/text/number_text.hpp"
#include "campaign/base/text/printable.hpp"
#include "campaign/curves/gas_curves.hpp"
#include "campaign/curves/labels.hpp"
#include "campaign/curves/theory_lines.hpp"
#include "campaign/plot/colours.hpp"
#include "campaign/plot/text_picture.hpp"

namespace haff::campaign {
namespace {

// A legend of more gases than this becomes a scale of tones, or stands beside the axes.
constexpr std::size_t most_in_legend = 10;

// More points than this on a curve are drawn as a line with a band.
constexpr std::size_t many_points = 30;

// A direct simulation takes a second or so.
constexpr std::size_t most_simulations = 12;

constexpr int theory_points = 160;

// ---- which gas is which -----------------------------------------------------------------------

std::vector<const Scene*> scenes_of(const std::vector<GasCurve>& curves) {
  std::vector<const Scene*> scenes;
  scenes.reserve(curves.size());
  for (const GasCurve& curve : curves) scenes.push_back(&curve.scene);
  return scenes;
}

// Names by which the legend goes: those asked for first, then whatever else varies.
std::vector<std::string> names_for(const Question& question, const std::vector<GasCurve>& curves) {
  std::vector<std::string> names = question.by;
  for (std::string& name : varying(scenes_of(curves)))
    if (std::ranges::find(names, name) == names.end()) names.push_back(std::move(name));
  return names;
}

void sort_by(const std::vector<std::string>& names, std::vector<GasCurve>& curves) {
  std::ranges::stable_sort(curves, [&](const GasCurve& a, const GasCurve& b) {
    for (const std::string& name : names) {
      const ParameterValue *one = a.scene.find(name), *other = b.scene.find(name);
      if (one == nullptr || other == nullptr) {
        if (one != other) return one == nullptr;
        continue;
      }
      if (*one != *other) return *one < *other;
    }
    return false;
  });
}

std::string number_of(const std::string& name, const ParameterValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return printable(*text);
  const double number = std::get<double>(value);
  if (name == "N") return count_text(static_cast<long long>(number));
  return number_text(number);
}

// The tau of curves in a lag is the waiting time that they begin at.
std::string word_for(const std::string& name, const std::string& variable) {
  return name == "tau" && variable == "lag" ? "tau_w" : name;
}

// "e = 0.9, N = 8 000": of a legend in enhanced text, of tables and captions as it is.
std::string label_of(const Scene& scene, const std::vector<std::string>& names, bool enhanced,
                     const std::string& variable = {}) {
  std::string text;
  for (const std::string& name : names) {
    const ParameterValue* value = scene.find(name);
    if (value == nullptr) continue;
    const std::string number = number_of(name, *value), word = word_for(name, variable);
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", enhanced ? symbol(word) : word,
                        enhanced ? literal(number) : number);
  }
  const bool lacks_effect = std::ranges::any_of(names, [&](const std::string& name) {
    return !effect_of(name).empty() && scene.find(name) == nullptr;
  });
  const bool has_effect = std::ranges::any_of(
      scene.parameters, [](const auto& each) { return !effect_of(each.first).empty(); });
  if (lacks_effect && !has_effect) text += text.empty() ? "no effect" : ", no effect";
  return text;
}

// ---- colours ----------------------------------------------------------------------------------

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

// Curves of equal values of what was asked for share a colour, and differ in their symbols.
class Styles {
 public:
  Styles(const Question& question, const std::vector<GasCurve>& curves,
         const std::vector<std::string>& names, const std::string& variable)
      : by_(question.by.empty() ? names : question.by), primary_(primary(question, curves, names)) {
    scale_ = tone_scale(curves, primary_, variable);
    for (const GasCurve& curve : curves) {
      const std::string group = label_of(curve.scene, by_, false);
      if (std::ranges::find(groups_, group) == groups_.end()) groups_.push_back(group);
    }
  }

  const std::optional<ToneScale>& scale() const { return scale_; }
  std::string tone() const { return scale_ ? primary_ : std::string(); }

  void apply(const GasCurve& gas, Curve& curve) {
    constexpr std::array symbols{7, 5, 9, 13, 11, 6, 4, 8, 12, 10};  // gnuplot's, filled first
    const std::string group = label_of(gas.scene, by_, false);
    const auto place =
        static_cast<std::size_t>(std::ranges::find(groups_, group) - groups_.begin());
    curve.colour =
        scale_ ? scale_->tone(gas.scene.number(primary_).value()) : colour(place, groups_.size());
    const std::size_t twin = seen_[group]++;
    curve.symbol = symbols[twin % symbols.size()];
    if (curve.look != Look::symbols && twin > 0) {
      constexpr std::array looks{Look::dashed, Look::dotted, Look::dash_dotted};
      curve.look = looks[(twin - 1) % looks.size()];
    }
  }

 private:
  std::vector<std::string> by_;
  std::string primary_;
  std::optional<ToneScale> scale_;
  std::vector<std::string> groups_;
  std::map<std::string, std::size_t> seen_;
};

// ---- curves -----------------------------------------------------------------------------------

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

std::vector<double> steps(double from, double to, int count) {
  std::vector<double> values;
  for (int i = 0; i <= count; ++i) values.push_back(from + (to - from) * i / count);
  return values;
}

// Line by line ours less theirs, where both have it.
std::vector<TheoryLine> subtracted(std::vector<TheoryLine> ours,
                                   const std::vector<TheoryLine>& theirs) {
  std::vector<TheoryLine> left;
  for (TheoryLine& line : ours) {
    const auto same = std::ranges::find(theirs, line.name, &TheoryLine::name);
    if (same == theirs.end()) continue;
    for (std::size_t i = 0; i < line.values.size(); ++i) {
      line.values[i] -= same->values[i];
      if (i < line.errors.size() && i < same->errors.size())
        line.errors[i] = std::hypot(line.errors[i], same->errors[i]);
    }
    left.push_back(std::move(line));
  }
  return left;
}

template <class Of>
std::vector<TheoryLine> theory_of(const Gas& gas, Of&& of) {
  auto lines = of(gas.job);
  return gas.reference ? subtracted(std::move(lines), of(*gas.reference)) : lines;
}

// A theory line with its x.
struct PlacedLine {
  TheoryLine line;
  std::vector<double> x;
};

// Without what lies beyond `last`: x increases.
void cut_after(PlacedLine& placed, double last) {
  const auto kept =
      static_cast<std::size_t>(std::ranges::upper_bound(placed.x, last) - placed.x.begin());
  placed.x.resize(kept);
  placed.line.values.resize(kept);
  if (!placed.line.errors.empty()) placed.line.errors.resize(kept);
}

// The tau by which both clocks of theory have passed a time; 0 where theory has none. A gas can be
// sampled at any moments, so their number says nothing of it.
double tau_after(double time, const schema::Job& job) {
  constexpr double farthest =
      1e6;  // no gas of ours gets there, and a clock that is not a number ends
  for (double end = 1; end < farthest; end *= 2) {
    const auto tau = steps(0, end, theory_points);
    std::size_t passed = 0;
    for (const char* clock : {"temperature_haff", "temperature_energy_equation_non_gaussian"}) {
      const auto times = times_of({.name = clock, .legend = {}}, job, tau, Simulations::left_out);
      const auto here = std::ranges::lower_bound(times, time) - times.begin();
      if (!times.empty()) passed = std::max(passed, static_cast<std::size_t>(here));
    }
    if (passed < tau.size()) return tau[passed];
  }
  return farthest;
}

std::vector<PlacedLine> theory_along_run(const Topic& topic, const GasCurve& gas) {
  std::vector<PlacedLine> placed;
  if (topic.kind == Topic::Kind::profile) {
    const double tau = gas.scene.number("tau").value_or(0);
    std::vector<double> x;
    for (const CurvePoint& point : gas.points) x.push_back(point.x);
    if (x.size() > 1) x = steps(x.front(), x.back(), theory_points);
    for (TheoryLine& line : theory_of(gas.gases.front(), [&](const schema::Job& job) {
           return theory_of_profile(topic.y, job, tau, x);
         }))
      placed.push_back({std::move(line), x});
    return placed;
  }
  if (topic.x != "tau" && topic.x != "time") return placed;
  const schema::Job& job = gas.gases.front().job;
  const double last = gas.points.back().x;
  const auto tau = steps(0, topic.x == "time" ? tau_after(last, job) : last, theory_points);
  for (TheoryLine& line : theory_of(gas.gases.front(), [&](const schema::Job& each) {
         return theory_in_tau(topic.y, each, tau);
       })) {
    auto x = topic.x == "time" ? times_of(line, job, tau) : tau;
    if (x.empty()) continue;
    placed.push_back({std::move(line), std::move(x)});
    cut_after(placed.back(), last);
  }
  return placed;
}

// One theory value of each gas of a curve, or of like gases in between where it costs nothing.
std::vector<Gas> gases_between(const Topic& topic, const GasCurve& curve, bool is_dear,
                               std::vector<double>& x) {
  const bool is_parameter = topic.x == "e" || topic.x == "n";
  if (!is_parameter || is_dear || curve.points.size() < 2) {
    std::vector<Gas> gases;
    for (const CurvePoint& point : curve.points) {
      gases.push_back(curve.gases[point.gas]);
      x.push_back(point.x);
    }
    return gases;
  }
  x = steps(curve.points.front().x, curve.points.back().x, 40);
  if (topic.x == "e")  // of which direct simulation is in the table
    for (const double e : analysis::tabulated_restitutions(curve.gases.front().job.d))
      if (e > x.front() && e < x.back()) x.push_back(e);
  std::ranges::sort(x);
  std::vector<Gas> gases;
  for (const double value : x) {
    Gas gas = curve.gases.front();
    (topic.x == "e" ? gas.job.e.emplace() : gas.job.n) = value;
    // A reference of another e stays where it is; of another effect it moves along.
    if (gas.reference && gas.reference->effects != gas.job.effects)
      (topic.x == "e" ? gas.reference->e.emplace() : gas.reference->n) = value;
    gases.push_back(std::move(gas));
  }
  return gases;
}

std::vector<PlacedLine> theory_of_gases(const Topic& topic, const GasCurve& curve, bool is_dear) {
  std::vector<double> x;
  const auto gases = gases_between(topic, curve, is_dear, x);
  std::vector<PlacedLine> placed;
  for (std::size_t i = 0; i < gases.size(); ++i) {
    const auto lines = theory_of(gases[i], [&](const schema::Job& job) {
      if (topic.kind == Topic::Kind::quantity) return theory_of_quantity(topic.quantity, job);
      if (!topic.window) return std::vector<TheoryLine>{};
      return theory_of_mean(topic.y, job, topic.window->first, topic.window->second);
    });
    for (const TheoryLine& line : lines) {
      auto found = std::ranges::find(placed, line.name,
                                     [](const PlacedLine& each) { return each.line.name; });
      if (found == placed.end()) {
        placed.push_back({line, {}});
        placed.back().line.values.clear();
        found = std::prev(placed.end());
      }
      found->x.push_back(x[i]);
      found->line.values.push_back(line.values.front());
    }
  }
  return placed;
}

bool is_dear(const GasCurve& curve) {
  return std::ranges::any_of(curve.gases, [](const Gas& gas) {
    return gas.job.effects.contains("thermostat") || gas.job.effects.contains("restitution");
  });
}

// Lines of all curves; those that several gases share, such as Haff's law of several densities, are
// drawn once and in grey.
void add_theory(const Topic& topic, const std::vector<GasCurve>& gases, Panel& panel,
                std::vector<std::string>& notes) {
  std::vector<std::string> kinds;  // that have an entry in the legend
  std::vector<Curve> lines;
  std::size_t simulations = 0;
  bool any_left_out = false;
  for (std::size_t i = 0; i < gases.size(); ++i) {
    const bool dear = is_dear(gases[i]);
    if (dear) simulations += is_along_runs(topic) ? 1 : gases[i].gases.size();
    if (dear && simulations > most_simulations) {
      any_left_out = true;
      continue;
    }
    for (PlacedLine& each : is_along_runs(topic) ? theory_along_run(topic, gases[i])
                                                 : theory_of_gases(topic, gases[i], dear)) {
      const auto same = std::ranges::find_if(
          lines, [&](const Curve& line) { return line.x == each.x && line.y == each.line.values; });
      if (same != lines.end()) {
        same->colour = "#444444";
        continue;
      }
      Curve line{.name = each.line.name + (gases.size() > 1 ? ", " + panel.curves[i].name : ""),
                 .source = Source::theory,
                 .e = panel.curves[i].e,
                 .n = panel.curves[i].n,
                 .particles = panel.curves[i].particles,
                 .parameters = panel.curves[i].parameters,
                 .x = std::move(each.x),
                 .y = std::move(each.line.values),
                 .error = std::move(each.line.errors),
                 .look = each.line.look,
                 .colour = panel.curves[i].colour,
                 .width = 1.5};
      lines.push_back(std::move(line));
      if (std::ranges::find(kinds, each.line.legend) != kinds.end()) continue;
      kinds.push_back(each.line.legend);
      panel.curves.push_back({.legend = each.line.legend,
                              .source = Source::theory,
                              .look = each.line.look,
                              .colour = "#444444",
                              .width = 1.5});
    }
  }
  // Entries of the legend stand behind the gases, lines are drawn over all.
  panel.curves.insert(panel.curves.end(), lines.begin(), lines.end());
  if (lines.empty()) notes.emplace_back("No theory here knows this.");
  if (any_left_out)
    notes.push_back(
        fmt::format("The direct simulation is left out beyond {} gases.", most_simulations));
}

// chi is in the lengths of theories with correlations, in Z, in collision rates, and in the time
// that tau takes.
bool takes_contact_value(const Curve& curve, const std::string& x) {
  if (curve.source != Source::theory) return false;
  constexpr std::array marks{"_energy_equation", "compressible", "_enskog", "collision_rate",
                             "correlation_trace"};
  return x == "time" || std::ranges::any_of(marks, [&](const char* mark) {
           return curve.name.find(mark) != std::string::npos;
         });
}

std::string contact_value_note(const Panel& panel) {
  const bool any = std::ranges::any_of(
      panel.curves, [&](const Curve& curve) { return takes_contact_value(curve, panel.x.column); });
  return any ? " Theory: χ of Carnahan and Starling, of disks Henderson's." : "";
}

// ---- axes and captions ------------------------------------------------------------------------

void check_logarithmic(const Panel& panel) {
  const auto check = [&](const Axis& axis, const char* letter, std::vector<double> Curve::*values) {
    if (!axis.logarithmic) return;
    for (const Curve& curve : panel.curves)
      if (std::ranges::any_of(curve.*values, [](double value) { return value > 0; })) return;
    throw NothingToDraw(fmt::format("nothing to draw with --log {0}: no {0} is above 0", letter));
  };
  check(panel.x, "x", &Curve::x);
  check(panel.y, "y", &Curve::y);
}

void set_y_range(const std::vector<Curve>& shown, std::size_t gases, Axis& axis) {
  const std::vector<Curve> measured(shown.begin(),
                                    shown.begin() + static_cast<std::ptrdiff_t>(gases));
  const Range own = y_range(measured, axis.logarithmic);
  Range range = own;
  // Theory may leave the picture, but not before it is seen to.
  const Range all = y_range(shown, axis.logarithmic);
  if (axis.logarithmic) {
    const double room = std::max(1.05, std::pow(own.high / own.low, 0.05));
    axis.low = std::max(all.low, own.low / std::pow(own.high / own.low, 0.3)) / room;
    axis.high = std::min(all.high, own.high * std::pow(own.high / own.low, 0.3)) * room;
    return;
  }
  range.low = std::max(all.low, own.low - 0.5 * own.width());
  range.high = std::min(all.high, own.high + 0.5 * own.width());
  const double room =
      range.width() > 0 ? 0.05 * range.width() : std::max(1e-12, std::abs(own.high));
  axis.low = range.low - room;
  axis.high = range.high + room;
}

void set_x_range(const Panel& panel, Axis& axis) {
  // Beyond the last value that is not 0, nothing is to be seen: bins without particles, say.
  double low = INFINITY, high = -INFINITY;
  for (const Curve& curve : panel.curves) {
    if (curve.source != Source::measured) continue;
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
      if (axis.logarithmic && !(curve.x[i] > 0)) continue;
      if (panel.y.logarithmic && !(curve.y[i] > 0)) continue;
      low = std::min(low, curve.x[i]);
      if (curve.y[i] != 0 || high == -INFINITY) high = std::max(high, curve.x[i]);
    }
  }
  if (!(low < high)) return;
  const bool starts_at_zero = low >= 0 && low < 0.2 * high && !axis.logarithmic;
  if (axis.logarithmic) {
    const double room = std::pow(high / low, 0.03);
    axis.low = low / room;
    axis.high = high * room;
    return;
  }
  const double room = 0.03 * (high - low);
  axis.low = starts_at_zero ? 0 : low - room;
  // A line may end at the frame, a symbol would be cut by it.
  const bool may_touch =
      panel.curves.front().look == Look::line && panel.curves.front().x.size() > most_in_legend;
  axis.high = high + (starts_at_zero && may_touch ? 0 : room);
}

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

// `tone` is the parameter that a scale of tones shows, empty without one.
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

// Legend or scale stand beside the axes, where they hide no curve. Returns the picture's width.
int place_legend(Panel& panel) {
  constexpr int axes_width = 640, scale_width = 90, sample_width = 60;  // pixels
  std::size_t longest = 0, entries = 0;
  for (const Curve& curve : panel.curves) {
    if (curve.legend.empty()) continue;
    ++entries;
    longest = std::max(longest, without_markup(curve.legend).size());
  }
  const double letter = entries > 8 ? 6.3 : 8.4;  // wide in the type that the legend will have
  int beside = panel.scale ? scale_width : 0;
  panel.legend = entries == 0 ? "none" : "beside";
  if (entries > 0) beside += sample_width + static_cast<int>(letter * static_cast<double>(longest));
  panel.axes_share = static_cast<double>(axes_width) / (axes_width + beside);
  return axes_width + beside;
}

std::string y_label(const Question& question, const Topic& topic) {
  std::string text = axis_label(topic.y);
  if (!question.difference) return text;
  const auto& [name, value] = *question.difference;
  return text + ", less that at " + symbol(name) + " = " + literal(value);
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
  set_x_range(panel, panel.x);
  set_y_range(panel.curves, curves.all.size(), panel.y);
  const int width = place_legend(panel);
  const std::string of_theory = contact_value_note(panel);
  result.plot = {.panels = {std::move(panel)},
                 .caption = caption_of(question, topic, curves, names, styles.tone()) + of_theory,
                 .width = width};
  return result;
}

}  // namespace haff::campaign
