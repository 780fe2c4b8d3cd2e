// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/grid/grid.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>

#include "schema/grid/document.hpp"
#include "schema/grid/effects.hpp"
#include "schema/grid/examination/examiner.hpp"
#include "schema/grid/job.hpp"
#include "schema/grid/rules.hpp"
#include "schema/grid/source.hpp"

namespace haff::schema {

namespace {

std::string contents(const std::filesystem::path& path) try {
  std::ifstream stream(path, std::ios::binary);
  stream.exceptions(std::ios::failbit | std::ios::badbit);
  return {std::istreambuf_iterator<char>(stream), {}};
} catch (const std::ios_base::failure&) {
  throw GridError(path.string() + ": cannot be read: " + std::strerror(errno));
}

std::vector<std::uint64_t> seeds(const Placed& placed) {
  std::vector<std::uint64_t> list;
  if (placed.value.is_number()) {
    const auto count = static_cast<std::uint64_t>(placed.value.get<double>());
    for (std::uint64_t seed = 1; seed <= count; ++seed) list.push_back(seed);
  } else {
    for (const Json& seed : placed.value)
      list.push_back(static_cast<std::uint64_t>(seed.get<double>()));
  }
  return list;
}

std::vector<Target> targets(const Source& source) {
  const auto placed = source.find("target");
  if (!placed) return {};
  std::vector<Target> all;
  for (const auto& [quantity, wish] : placed->value.items()) {
    Target target{.series = {}, .quantity = quantity, .se = wish["se"].get<double>()};
    if (wish.contains("tau")) {
      target.tau_from = wish["tau"][0].get<double>();
      target.tau_to = wish["tau"][1].get<double>();
    }
    all.push_back(std::move(target));
  }
  return all;
}

Moments moments(const Json& value) {
  Moments moments;
  if (value.is_object()) {
    moments.per_decade = static_cast<int>(value["log"].get<double>());
    moments.from = value.value("from", usual_first_moment);
    return moments;
  }
  if (value.is_number()) return {.listed = {value.get<double>() + 0.0}};
  for (const Json& moment : value) moments.listed.push_back(moment.get<double>() + 0.0);
  std::ranges::sort(moments.listed);
  return moments;
}

Schedule schedule(const Source& source, const std::string& key) {
  const auto placed = source.find(key);
  if (!placed) return {};
  const Json& value = placed->value;
  const bool has_axes = value.is_object() && !value.contains("log");
  if (!has_axes) return {.tau = moments(value), .time = {}};
  return {.tau = value.contains("tau") ? moments(value["tau"]) : Moments{},
          .time = value.contains("time") ? moments(value["time"]) : Moments{}};
}

AskedStart asked_start(const Placed& placed, const std::string& file) {
  const Json& value = placed.value;
  AskedStart asked;
  const auto parameters = [&](const char* name) -> std::optional<Json> {
    if (value == name) return Json::object();
    return value.is_object() && value.contains(name) ? std::optional(value[name]) : std::nullopt;
  };
  if (value == "crystal") asked.start.kind = Start::Kind::crystal;
  if (const auto wave = parameters("shear wave")) {
    asked.start.kind = Start::Kind::shear_wave;
    asked.start.amplitude = wave->value("amplitude", usual_amplitude);
    asked.start.waves = static_cast<int>(wave->value("waves", static_cast<double>(usual_waves)));
  }
  if (const auto temperatures = parameters("two temperatures")) {
    asked.start.kind = Start::Kind::two_temperatures;
    asked.start.ratio = temperatures->value("ratio", usual_ratio);
  }
  if (value.is_object() && value.contains("file")) {
    asked.start.kind = Start::Kind::file;
    // A relative path begins where the grid lies: both are moved together.
    asked.file = std::filesystem::path(file).parent_path() / value["file"].get<std::string>();
    asked.place = file + ": " + (placed.where / "file").to_string();
  }
  return asked;
}

std::vector<AskedStart> starts(const Source& source, const std::string& file) {
  std::vector<AskedStart> all;
  for (const Placed& item : items(source["start"])) all.push_back(asked_start(item, file));
  return all;
}

std::vector<Effects> effects(const Placed& placed) {
  std::vector<Effects> all;
  for (Json& one : expanded(placed.value)) {
    // What is so without being asked for is no effect.
    if (one.value("/restitution/law"_json_pointer, "") == "constant") one.erase("restitution");
    Effects effects(one.dump());
    if (std::find(all.begin(), all.end(), effects) == all.end()) all.push_back(std::move(effects));
  }
  return all;
}

SubGrid sub_grid(const Source& source, std::vector<double> tau_max, const std::string& file) {
  SubGrid grid{.d = source.list<int>("d"),
               .e = source.e(),
               .n = source.list<double>("n"),
               .particles = source.list<std::uint32_t>("N"),
               .seeds = seeds(source["seeds"]),
               .tau_max = std::move(tau_max),
               .sample_every = source.list<double>("sample_every"),
               .sample_at = schedule(source, "sample_at"),
               .starts = starts(source, file),
               .equilibrate = source.list<double>("equilibrate"),
               .checkpoint_every = source["checkpoint_every"].value.get<double>(),
               .observables = source.observables(),
               .profiles_every = std::nullopt,
               .fields_at = {},
               .snapshots_at = schedule(source, "snapshots_at"),
               .effects = effects(source["effects"]),
               .targets = targets(source)};
  // They are kept where they decide what is measured. Elsewhere, two grids that differ in nothing
  // else are the same.
  const auto& names = grid.observables;
  if (std::any_of(names.begin(), names.end(), is_profile))
    grid.profiles_every = source["profiles_every"].value.get<double>();
  if (std::any_of(names.begin(), names.end(), is_field)) {
    grid.fields_at = source.list<double>("fields_at");
    std::sort(grid.fields_at.begin(), grid.fields_at.end());
  }
  return grid;
}

}  // namespace

Grid parse_grid(std::string_view text, const std::string& file, const Memory& memory,
                const Refusal& cannot_start) {
  const Json document = read_document(text, file);
  check_rules(document, file);
  ExaminedGrid examined = examine(document, file, memory, cannot_start);
  Grid grid{.name = document.value("name", ""), .grids = {}};
  for (std::size_t k = 0; k < examined.sources.size(); ++k)
    grid.grids.push_back(sub_grid(examined.sources[k], std::move(examined.tau_max[k]), file));
  return grid;
}

Grid read_grid(const std::filesystem::path& path, const Memory& memory,
               const Refusal& cannot_start) {
  return parse_grid(contents(path), path.string(), memory, cannot_start);
}

}  // namespace haff::schema
