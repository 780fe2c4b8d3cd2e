// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/curves/observations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

namespace haff::campaign {
namespace {

// A gas as the views of the store have it, then its tau where it is a profile's.
constexpr const char* gas_column_names =
    "d, n, particles, e, equilibrate, sample_every, effects, sample_at, start";
constexpr std::size_t gas_columns = 9;

std::optional<double> number(const schema::Value& value) {
  if (const auto* real = std::get_if<double>(&value)) return *real;
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  return std::nullopt;
}

std::string condition(const std::string& where, const Vocabulary& words) {
  return where.empty() ? std::string() : fmt::format(" WHERE ({})", translated(where, words));
}

// Rows of the gas, job_id, seed, code_version, and three numbers: place, x and y. Rows that lack
// one of them are left out.
Observations read(const schema::Reader& store, const std::string& sql, bool has_tau) {
  using schema::Part;
  store.must_match_digests({Part::samples, Part::profiles, Part::results});
  std::map<schema::Row, Observation> all;
  Observations result;
  auto rows = store.query(sql);
  const std::size_t keys = gas_columns + (has_tau ? 1 : 0);
  while (const auto found = rows.next()) {
    const schema::Row& row = *found;
    const auto place = number(row[keys + 3]), x = number(row[keys + 4]), y = number(row[keys + 5]);
    if (!place || !x || !y || !std::isfinite(*x) || !std::isfinite(*y)) continue;
    const auto [entry, is_new] =
        all.try_emplace({row.begin(), row.begin() + static_cast<std::ptrdiff_t>(keys)});
    Observation& each = entry->second;
    if (is_new) {
      each.scene = scene_of(store.job(std::get<std::int64_t>(row[keys])).job);
      if (has_tau) each.scene.parameters.emplace_back("tau", *number(row[keys - 1]));
    }
    const auto seed = static_cast<std::uint64_t>(std::get<std::int64_t>(row[keys + 1]));
    each.readings[*place].emplace(seed, Reading{.x = *x, .y = *y});
    if (const auto* version = std::get_if<std::string>(&row[keys + 2]);
        version && !version->empty())
      result.code_versions.insert(*version);
  }
  for (auto& entry : all) result.all.push_back(std::move(entry.second));
  return result;
}

}  // namespace

Observations samples_of(const schema::Reader& store, const Vocabulary& words, const std::string& y,
                        const std::string& x, const std::string& where) {
  const std::string variable = is_of_interval(y) ? at_middles(x) : x;
  return read(store,
              fmt::format("SELECT {}, job_id, seed, code_version, tau, ({}), ({}) FROM {}{}",
                          gas_column_names, translated(variable, words), translated(y, words),
                          sample_rows(words), condition(where, words)),
              false);
}

Observations means_of(const schema::Reader& store, const Vocabulary& words, const std::string& y,
                      const std::string& x, const std::string& where) {
  return read(store,
              fmt::format("SELECT {}, job_id, seed, code_version, 0, max({}), avg({}) FROM {}{} "
                          "GROUP BY job_id",
                          gas_column_names, translated(x, words), translated(y, words),
                          sample_rows(words), condition(where, words)),
              false);
}

Observations profiles_of(const schema::Reader& store, const Vocabulary& words,
                         const std::string& profile, const std::string& where) {
  return read(store,
              fmt::format("SELECT {}, tau, job_id, seed, code_version, x, x, value FROM {}{}",
                          gas_column_names, profile_rows(words, profile), condition(where, words)),
              true);
}

Observations quantities_of(const schema::Reader& store, const Vocabulary& words,
                           const Quantity& quantity, const std::string& x,
                           const std::string& where) {
  std::map<std::int64_t, double> chosen;  // x by job
  auto rows = store.query(fmt::format("SELECT job_id, ({}) FROM {}{}", translated(x, words),
                                      job_rows(words), condition(where, words)));
  while (const auto row = rows.next())
    if (const auto value = number(row->at(1))) chosen[std::get<std::int64_t>(row->at(0))] = *value;

  std::map<std::string, Observation> all;
  std::vector<std::string> order;
  Observations result;
  for (const schema::JobRow& row : store.jobs()) {
    const auto place = chosen.find(row.job_id);
    if (place == chosen.end()) continue;
    FinishedRun run = finished_run(store, row);
    if (quantity.measure == Measure::correlation)
      run.correlations = store.profiles(row.job_id, "G_parallel");
    const auto value = value_of(quantity, row.job, run);
    if (!value) continue;
    const std::string key = schema::series_identity(unobserved(row.job));
    Observation& each = all[key];
    if (each.readings.empty()) {
      each.scene = scene_of(row.job);
      order.push_back(key);
    }
    each.readings[0].emplace(row.job.seed, Reading{.x = place->second, .y = *value});
    if (row.code_version && !row.code_version->empty())
      result.code_versions.insert(*row.code_version);
  }
  for (const std::string& key : order) result.all.push_back(std::move(all[key]));
  return result;
}

void part_by_seed(Observations& observations) {
  std::vector<Observation> parted;
  for (const Observation& each : observations.all) {
    std::map<std::uint64_t, Observation> by_seed;
    for (const auto& [place, readings] : each.readings)
      for (const auto& [seed, reading] : readings) by_seed[seed].readings[place][seed] = reading;
    for (auto& [seed, single] : by_seed) {
      single.scene = each.scene;
      single.scene.parameters.emplace_back("seed", static_cast<double>(seed));
      parted.push_back(std::move(single));
    }
  }
  observations.all = std::move(parted);
}

}  // namespace haff::campaign
