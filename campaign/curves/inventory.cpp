// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/curves/inventory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <variant>

#include "campaign/base/text/number_text.hpp"
#include "campaign/curves/vocabulary.hpp"
#include "schema/grid/observables.hpp"

namespace haff::campaign {
namespace {

struct Meaning {
  std::string_view name, meaning;
};
constexpr std::array meanings{
    Meaning{"time", "true time [sigma sqrt(m/E(0))]"},
    Meaning{"temperature", "granular temperature (m/d) <v^2>, of translation [E(0)]"},
    Meaning{"gamma_ratio", "decay rate gamma/gamma_0 over the interval before the sample"},
    Meaning{"collision_rate", "collisions suffered per particle and time, likewise"},
    Meaning{"pressure", "n T + collisional virial, likewise [E(0)/sigma^d]"},
    Meaning{"a2", "Laguerre (Sonine) coefficient of the velocity distribution"},
    Meaning{"a3", "likewise"},
    Meaning{"a4", "likewise"},
    Meaning{"a5", "likewise"},
    Meaning{"a6", "likewise"},
    Meaning{"correlation_trace", "Tr G+(0), cut off at k_M [E(0)/m]"},
    Meaning{"largest_cluster", "share of the particles in the largest dense region"},
    Meaning{"rotational_temperature", "temperature of rotation (roughness) [E(0)]"},
    Meaning{"temperature_1", "temperature of species 1 (mixture) [E(0)]"},
    Meaning{"temperature_2", "likewise of species 2"},
};

std::string meaning_of(const std::string& name) {
  const auto derived = std::ranges::find(derived_columns, name, &DerivedColumn::name);
  if (derived != derived_columns.end()) return std::string(derived->meaning);
  const auto found = std::ranges::find(meanings, name, &Meaning::name);
  return found == meanings.end() ? std::string() : std::string(found->meaning);
}

std::string curve_meaning(const std::string& profile) {
  const schema::Curve* curve = schema::find_curve(profile);
  return curve == nullptr ? std::string() : std::string(curve->meaning);
}

bool has_rows(const schema::Reader& store, const std::string& sql) {
  return store.query(sql + " LIMIT 1").next().has_value();
}

std::vector<schema::Value> values_of(const schema::Reader& store, const std::string& sql) {
  std::vector<schema::Value> values;
  auto rows = store.query(sql);
  while (const auto row = rows.next()) values.push_back(row->front());
  return values;
}

std::string text_of(const schema::Value& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* real = std::get_if<double>(&value)) return number_text(*real);
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *whole);
  return "";
}

}  // namespace

Inventory inventory_of(const schema::Reader& store) {
  const Vocabulary words = vocabulary_of(store);
  Inventory inventory;
  for (const std::string& name : words.columns)
    if (has_rows(store,
                 fmt::format("SELECT 1 FROM {} WHERE {} IS NOT NULL", sample_rows(words), name)))
      inventory.columns.push_back({.name = name, .meaning = meaning_of(name)});
  for (const std::string& name : words.profiles)
    inventory.profiles.push_back(
        {.name = name,
         .variable = profile_variable(name),
         .meaning = curve_meaning(name),
         .taus = values_of(store, fmt::format("SELECT DISTINCT tau FROM {} ORDER BY tau",
                                              profile_rows(words, name)))});
  inventory.quantities = {
      {.name = "tau_c", .meaning = "collisions until T is twice what Haff's law says"},
      {.name = "a2, a3, a4", .meaning = "mean over tau 5 to 15; a2@3:8 over another window"},
      {.name = "gamma_ratio@20", .meaning = "decay rate over tau 18 to 22; gamma_ratio@10:30"},
      {.name = "ln_temperature@50", .meaning = "ln(T/T(0)) at this tau"},
      {.name = "G_parallel@50", .meaning = "velocity correlation at r = 5 sigma and this tau"}};
  for (const std::string& name : words.parameters)
    inventory.parameters.push_back(
        {.name = name,
         .values = values_of(store, fmt::format("SELECT DISTINCT {0} AS value FROM {1} WHERE value "
                                                "IS NOT NULL ORDER BY value",
                                                translated(name, words), job_rows(words)))});
  return inventory;
}

std::string listed(const std::vector<schema::Value>& values) {
  constexpr std::size_t most = 12, ends = 4;
  std::vector<std::string> texts;
  texts.reserve(values.size());
  for (const schema::Value& value : values) texts.push_back(text_of(value));
  if (texts.size() <= most) return fmt::format("{}", fmt::join(texts, ", "));
  const auto first = texts.begin(), last = texts.end();
  return fmt::format("{}, ..., {} ({} values)", fmt::join(first, first + ends, ", "),
                     fmt::join(last - ends, last, ", "), texts.size());
}

}  // namespace haff::campaign
