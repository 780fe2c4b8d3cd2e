// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/grid/examination/examiner.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "schema/grid/examination/box.hpp"
#include "schema/grid/examination/combinations.hpp"
#include "schema/grid/examination/targets.hpp"
#include "schema/grid/examination/tau.hpp"
#include "schema/grid/rules.hpp"

namespace haff::schema {

namespace {

// A plan takes 1 kB of memory and 1 kB of the store for each job.
constexpr double most_jobs = 2e6;

// Each is a series of its own, and a line of a plan.
constexpr double most_effects = 10'000;

// No list holds a value twice, however it is written.
void must_not_repeat(const std::string& file, const Json& value, const Pointer& where) {
  if (value.is_object())
    for (const auto& [key, member] : value.items()) must_not_repeat(file, member, where / key);
  if (!value.is_array()) return;
  std::map<Json, std::size_t> first;  // of scalars
  for (std::size_t i = 0; i < value.size(); ++i) {
    must_not_repeat(file, value[i], where / i);
    if (!value[i].is_primitive()) continue;
    const auto [known, is_new] = first.try_emplace(value[i], i);
    if (!is_new)
      throw fault(file, where / i,
                  shown(value[i]) + " is already at " + (where / known->second).to_string() +
                      "; expected each value once");
  }
}

void must_be_complete(const std::string& file, const Source& source) {
  for (const std::string& key : required_keys())
    if (!source.find(key))
      throw fault(file, source.where(),
                  "has no \"" + key + "\", and there is none beside \"grids\"; expected " +
                      description(key));
}

// Lists within effects multiply: their product must be one that can be made.
void effects_must_be_few(const std::string& file, const Source& source) {
  const Placed effects = source["effects"];
  if (const double count = count_expanded(effects.value); count > most_effects)
    throw fault(file, effects.where,
                "makes " + rounded(count) + " combinations of effects; expected at most " +
                    text(most_effects));
}

// A plan holds all of its jobs at once.
void jobs_must_be_few(const std::string& file, const std::vector<Source>& sources) {
  double jobs = 0;
  for (const Source& source : sources) {
    double product = std::max<double>(1, static_cast<double>(source.e().size())) *
                     count_expanded(source["effects"].value);
    for (const char* key : {"d", "n", "N", "start", "equilibrate", "sample_every"})
      product *= static_cast<double>(items(source[key]).size());
    const Placed seeds = source["seeds"];
    product *= seeds.value.is_number() ? seeds.value.get<double>()
                                       : static_cast<double>(seeds.value.size());
    jobs += product;
    if (jobs > most_jobs)
      throw fault(file, source.where(),
                  "makes " + rounded(jobs) + " jobs in all; expected at most " +
                      rounded(most_jobs) + " in one plan");
  }
}

}  // namespace

ExaminedGrid examine(const Json& document, const std::string& file, const Memory& memory,
                     const Refusal& cannot_start) {
  must_not_repeat(file, document, Pointer());
  ExaminedGrid grid{.sources = sources(document), .tau_max = {}};
  for (const Source& source : grid.sources) {
    must_be_complete(file, source);
    effects_must_be_few(file, source);
    must_go_together(file, source);
    must_have_a_start(file, source);
  }
  must_have_no_strays(file, grid.sources);
  for (const Source& source : grid.sources) {
    must_fit(file, source, memory);
    must_collide_between_samples(file, source);
    must_be_packable(file, source, cannot_start);
    auto tau_max = tau_max_of_each_e(file, source);
    must_lie_within_run(file, source, tau_max);
    must_be_reachable(file, source, tau_max);
    grid.tau_max.push_back(std::move(tau_max));
  }
  jobs_must_be_few(file, grid.sources);
  return grid;
}

}  // namespace haff::schema
