// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/curves/question.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "campaign/base/text/number_text.hpp"
#include "schema/database/sql_names.hpp"
#include "schema/grid/suggestion.hpp"

namespace haff::campaign {
namespace {

constexpr const char* see_list = "; `campaign plot --list` names what this store has";

bool has(const std::vector<std::string>& words, std::string_view word) {
  return std::ranges::find(words, word) != words.end();
}

bool is_parameter(const Vocabulary& words, const std::string& name) {
  return has(words.parameters, name) || name == "particles" || name == "seed";
}

bool is_column(const Vocabulary& words, const std::string& name) {
  return has(words.columns, name) || name == "tau";
}

bool is_profile(const Vocabulary& words, const std::string& name) {
  return has(words.profiles, name);
}

bool mentions_tau(const std::string& sql) {
  return has(schema::names_in(sql), "tau");
}

std::vector<std::string> joined(std::vector<std::string> a, const std::vector<std::string>& b) {
  for (const std::string& word : b)
    if (!has(a, word)) a.push_back(word);
  return a;
}

// An expression in parameters alone.
bool is_of_parameters(const std::string& sql, const Vocabulary& words) {
  const auto names = schema::names_in(sql);
  return !names.empty() && std::ranges::all_of(names, [&](const std::string& name) {
    return is_parameter(words, name);
  });
}

// Checks that every name in an expression is a column or a parameter; SQLite finds other errors.
void check_expression(const std::string& sql, const Vocabulary& words,
                      const std::vector<std::string>& known) {
  const auto names = schema::names_in(sql);
  if (names.empty()) throw QuestionError(fmt::format("{} names nothing to draw{}", sql, see_list));
  for (const std::string& name : names) {
    if (is_column(words, name) || is_parameter(words, name)) continue;
    if (has({"AND", "OR", "NOT", "CASE", "WHEN", "THEN", "ELSE", "END", "IS", "NULL"}, name))
      continue;
    throw QuestionError(
        fmt::format("{} is not known here: {}{}", name, schema::suggestion(name, known), see_list));
  }
}

std::pair<double, double> window_in(const std::string& text, const std::string& y) {
  const auto colon = text.find(':');
  const auto from = number_in(text.substr(0, colon));
  const auto to = colon == std::string::npos ? from : number_in(text.substr(colon + 1));
  if (!from || !to || *from < 0 || *to < *from)
    throw QuestionError(fmt::format(
        "{}@{}: expected a tau or a window of tau behind @, e.g. {}@20 or {}@5:15", y, text, y, y));
  return {*from, *to};
}

// Rows of a mean over a window; tau of samples are rounded.
std::string within(const std::pair<double, double>& window, const std::string& where) {
  constexpr double rounding = 1e-9;
  return fmt::format("tau BETWEEN {:.17g} AND {:.17g}{}", window.first - rounding,
                     window.second + rounding, where.empty() ? "" : " AND (" + where + ")");
}

Topic of_parameters(const Question& question, const Vocabulary& words, const std::string& y,
                    const std::string& at) {
  Topic topic{.y = y, .x = question.against, .where = question.where};
  const auto measure = measure_named(y);
  const bool plateau = measure && (is_laguerre(*measure) || *measure == Measure::tau_c);
  std::optional<Quantity> quantity;
  if (measure && !at.empty())
    quantity = quantity_at(*measure, at);
  else if (plateau && !mentions_tau(question.where))
    quantity = usual_quantity(*measure);
  if (quantity) {
    topic.kind = Topic::Kind::quantity;
    topic.quantity = *quantity;
    return topic;
  }
  topic.kind = Topic::Kind::mean;
  const bool is_known = is_profile(words, y) || (measure && !is_column(words, y));
  if (!at.empty() && is_known)
    throw QuestionError(
        fmt::format("{}@{} is no number of a run: only G_parallel, at 5 sigma and "
                    "one tau, and ln_temperature at one tau are",
                    y, at));
  if (is_known || (at.empty() && !mentions_tau(question.where)))
    throw QuestionError(fmt::format(
        "{} changes with tau: say where to take it, {}@20, or as a mean {}@5:15", y, y, y));
  check_expression(y, words, joined(joined(words.columns, words.profiles), quantity_names()));
  if (!at.empty()) {
    topic.window = window_in(at, y);
    topic.where = within(*topic.window, question.where);
  }
  return topic;
}

Topic of_profile(const Question& question, const std::string& y, const std::string& at) {
  Topic topic{
      .kind = Topic::Kind::profile, .y = y, .x = profile_variable(y), .where = question.where};
  if (!question.against.empty() && question.against != topic.x && question.against != "x")
    throw QuestionError(
        fmt::format("{} is a curve in {}: draw it --against {}, or G_parallel@50 "
                    "--against a parameter",
                    y, topic.x, topic.x));
  if (!at.empty()) topic.where = within(window_in(at, y), question.where);
  return topic;
}

Topic of_samples(const Question& question, const Vocabulary& words, const std::string& y,
                 const std::string& at) {
  Topic topic{.kind = Topic::Kind::series, .y = y, .x = question.against, .where = question.where};
  if (topic.x.empty()) topic.x = "tau";
  if (y == "tau_c" || !at.empty())
    throw QuestionError(fmt::format(
        "{} is one number of each run: draw it against a parameter, e.g. --against e", question.y));
  if (y == "ln_temperature")
    throw QuestionError("draw temperature with --log y: ln_temperature is of one tau");
  check_expression(y, words, joined(joined(words.columns, words.profiles), quantity_names()));
  check_expression(topic.x, words,
                   joined({"tau", "time"}, joined(words.parameters, words.columns)));
  return topic;
}

void check_parameters(const Question& question, const Topic& topic, const Vocabulary& words) {
  auto known = words.parameters;
  known.emplace_back("seed");
  if (topic.kind == Topic::Kind::profile) known.emplace_back("tau");
  for (const std::string& name : question.by)
    if (!has(known, name))
      throw QuestionError(fmt::format("--by {}: no parameter is called so: {}{}", name,
                                      schema::suggestion(name, known), see_list));
  if (!question.difference) return;
  for (const std::string& name : words.parameters)
    if (const auto dot = name.find('.'); dot != std::string::npos)
      known = joined(known, {name.substr(0, dot)});
  const auto& [name, value] = *question.difference;
  std::erase(known, "seed");
  if (!has(known, name))
    throw QuestionError(fmt::format("--difference {}={}: no parameter is called so: {}{}", name,
                                    value, schema::suggestion(name, known), see_list));
}

}  // namespace

Topic topic_of(const Question& question, const Vocabulary& words) {
  const auto place = question.y.rfind('@');
  const std::string y = question.y.substr(0, place);
  const std::string at = place == std::string::npos ? "" : question.y.substr(place + 1);
  if (y.empty()) throw QuestionError(std::string("what is to be drawn?") + see_list);
  if (place != std::string::npos) window_in(at, y);
  Topic topic;
  if (is_of_parameters(question.against, words))
    topic = of_parameters(question, words, y, at);
  else if (is_profile(words, y))
    topic = of_profile(question, y, at);
  else
    topic = of_samples(question, words, y, at);
  check_parameters(question, topic, words);
  return topic;
}

}  // namespace haff::campaign
