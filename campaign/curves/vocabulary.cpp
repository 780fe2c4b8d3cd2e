// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/curves/vocabulary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <variant>

#include "schema/database/sql_names.hpp"
#include "schema/grid/observables.hpp"

namespace haff::campaign {
namespace {

std::vector<std::string> texts(const schema::Reader& store, const std::string& sql) {
  std::vector<std::string> all;
  auto rows = store.query(sql);
  while (const auto row = rows.next())
    if (const auto* text = std::get_if<std::string>(&row->front())) all.push_back(*text);
  return all;
}

bool is_word(std::string_view text) {
  return !text.empty() && std::isdigit(static_cast<unsigned char>(text.front())) == 0 &&
         std::ranges::all_of(text,
                             [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
}

// "roughness.beta". Effects come from the store: a name that is no word is no name.
std::vector<std::string> effect_parameters(const schema::Reader& store) {
  auto all = texts(store,
                   "SELECT DISTINCT effect || '.' || parameter FROM (SELECT min(job_id) AS job_id "
                   "FROM jobs WHERE kind = 'cooling' AND status = 'done' GROUP BY effects) "
                   "JOIN job_effects USING (job_id) ORDER BY 1");
  std::erase_if(all, [](const std::string& name) {
    const auto dot = name.find('.');
    return !is_word(name.substr(0, dot)) || !is_word(name.substr(dot + 1));
  });
  return all;
}

// Goes from name to name in the index of each job, without reading the points, which are many.
constexpr const char* profile_names =
    "WITH RECURSIVE step (job_id, name) AS ("
    " SELECT job_id, (SELECT min(name) FROM profiles WHERE profiles.job_id = jobs.job_id)"
    " FROM jobs WHERE kind = 'cooling' AND status = 'done'"
    " UNION ALL SELECT job_id, (SELECT min(profiles.name) FROM profiles"
    " WHERE profiles.job_id = step.job_id AND profiles.name > step.name)"
    " FROM step WHERE name IS NOT NULL) "
    "SELECT DISTINCT name FROM step WHERE name IS NOT NULL ORDER BY name";

std::string in_quotes(std::string_view text, char quote) {
  std::string result(1, quote);
  for (const char c : text) result += c == quote ? std::string(2, quote) : std::string(1, c);
  return result + quote;
}

bool is_effect(std::string_view parameter) {
  return parameter.find('.') != std::string_view::npos;
}

// ", effects ->> '$.roughness.beta' AS "roughness.beta"", and so on.
std::string effect_columns(const Vocabulary& words) {
  std::string sql;
  for (const std::string& name : words.parameters)
    if (is_effect(name))
      sql += fmt::format(", effects ->> '$.{}' AS {}", name, in_quotes(name, '"'));
  return sql;
}

constexpr const char* job_columns =
    "jobs.job_id AS job_id, jobs.d AS d, jobs.e AS e, jobs.n AS n, jobs.particles AS particles, "
    "jobs.equilibrate AS equilibrate, jobs.sample_every AS sample_every, "
    "jobs.sample_at AS sample_at, jobs.start AS start, jobs.effects AS effects, "
    "jobs.seed AS seed, jobs.tau_max AS tau_max, "
    "jobs.profiles_every AS profiles_every, coalesce(jobs.code_version, '') AS code_version";
constexpr const char* finished = "kind = 'cooling' AND status = 'done'";

// A column of the sample before.
std::string sample_before(std::string_view column) {
  return fmt::format(
      "(SELECT earlier.{} FROM samples AS earlier WHERE earlier.job_id = samples.job_id AND "
      "earlier.tau < samples.tau ORDER BY earlier.tau DESC LIMIT 1)",
      column);
}

}  // namespace

const std::vector<DerivedColumn> derived_columns = {
    {"energy", "d * samples.temperature / 2", "(d/2) T, of translation per particle [E(0)]"},
    {"Z",
     "samples.pressure / (n * sqrt(samples.temperature * " + sample_before("temperature") + "))",
     "pressure / (n T), T the geometric mean over the interval of the pressure"},
    {"rotational_ratio", "samples.rotational_temperature / samples.temperature",
     "temperature of rotation over that of translation (roughness)"},
    {"species_ratio", "samples.temperature_1 / samples.temperature_2",
     "T_1/T_2 of the species (mixture)"},
};

std::vector<std::string> quantity_names() {
  return {"tau_c", "a2", "a3", "a4", "gamma_ratio", "ln_temperature", "G_parallel"};
}

Vocabulary vocabulary_of(const schema::Reader& store) {
  Vocabulary words;
  words.columns = texts(store,
                        "SELECT name FROM pragma_table_info('samples') "
                        "WHERE name NOT IN ('job_id', 'tau')");
  for (const DerivedColumn& column : derived_columns) words.columns.emplace_back(column.name);
  words.profiles = texts(store, profile_names);
  words.parameters = {"d", "e", "n", "N", "equilibrate", "sample_every"};
  std::ranges::move(effect_parameters(store), std::back_inserter(words.parameters));
  return words;
}

std::string profile_variable(std::string_view profile) {
  const schema::Curve* curve = schema::find_curve(profile);
  return curve == nullptr ? "x" : std::string(curve->variable);
}

std::string translated(const std::string& sql, const Vocabulary& words) {
  return schema::with_names(sql, [&](std::string_view name) {
    if (name == "N") return std::string("particles");
    const bool is_known = std::ranges::find(words.parameters, name) != words.parameters.end();
    return is_effect(name) && is_known ? in_quotes(name, '"') : std::string(name);
  });
}

bool is_of_interval(std::string_view sql) {
  constexpr std::array<std::string_view, 4> columns{"gamma_ratio", "collision_rate", "pressure",
                                                    "Z"};
  return std::ranges::any_of(schema::names_in(sql), [&](const std::string& name) {
    return std::ranges::find(columns, name) != columns.end();
  });
}

std::string at_middles(const std::string& sql) {
  return schema::with_names(sql, [](std::string_view name) {
    const bool moves = name == "tau" || name == "time";
    return (moves ? "middle_" : "") + std::string(name);
  });
}

std::string job_rows(const Vocabulary& words) {
  return fmt::format("(SELECT {}{} FROM jobs WHERE {})", job_columns, effect_columns(words),
                     finished);
}

std::string sample_rows(const Vocabulary& words) {
  std::string columns;
  for (const std::string& name : words.columns) {
    const auto derived = std::ranges::find(derived_columns, name, &DerivedColumn::name);
    columns += derived == derived_columns.end() ? fmt::format(", samples.{0} AS {0}", name)
                                                : fmt::format(", {} AS {}", derived->sql, name);
  }
  return fmt::format(
      "(SELECT {}{}, samples.tau AS tau{}, iif(jobs.sample_at IS NULL, "
      "samples.tau - jobs.sample_every / 2, (samples.tau + {}) / 2) AS middle_tau, "
      "(samples.time + {}) / 2 AS middle_time FROM jobs JOIN samples USING (job_id) WHERE {})",
      job_columns, effect_columns(words), columns, sample_before("tau"), sample_before("time"),
      finished);
}

std::string profile_rows(const Vocabulary& words, const std::string& profile) {
  return fmt::format(
      "(SELECT {}{}, profiles.tau AS tau, x, x AS {}, value FROM jobs JOIN profiles USING (job_id) "
      "WHERE {} AND name = {})",
      job_columns, effect_columns(words),
      profile_variable(profile) == "x" ? "variable" : profile_variable(profile), finished,
      in_quotes(profile, '\''));
}

}  // namespace haff::campaign
