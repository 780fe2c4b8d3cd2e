// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/grid/examination/tau.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>
#include <system_error>

#include "schema/grid/job.hpp"
#include "schema/grid/observables.hpp"
#include "schema/grid/rules.hpp"

namespace haff::schema {

namespace {

// The whole numbers that a double holds exactly.
constexpr double most_collisions = 0x1p53;

// A sample is a row of 115 bytes: so many are 1 GB for each job.
constexpr double most_samples = 1e7;

// Each waiting time keeps 48 bytes of every particle, in memory and in the state.
constexpr std::size_t most_waiting_times = 16;

double restitution(const std::string& file, const Pointer& where, const std::string& key) {
  double e = 0;
  const char* end = key.data() + key.size();
  const auto read = std::from_chars(key.data(), end, e);
  if (read.ec != std::errc() || read.ptr != end)
    throw fault(file, where / key, "is not a number; expected an e of this grid");
  return shortest_decimal(e);
}

std::vector<double> matched(const std::string& file, const Placed& map,
                            const std::vector<double>& e) {
  std::vector<std::optional<double>> found(e.size());
  for (const auto& [key, value] : map.value.items()) {
    const auto same = std::find(e.begin(), e.end(), restitution(file, map.where, key));
    if (same == e.end()) continue;  // another grid's: see must_have_no_strays
    auto& tau_max = found[static_cast<std::size_t>(same - e.begin())];
    if (tau_max)
      throw fault(file, map.where / key,
                  "is the second entry for e = " + text(*same) + "; expected one");
    tau_max = value.get<double>();
  }
  std::vector<double> tau_max;
  for (std::size_t i = 0; i < e.size(); ++i) {
    if (!found[i])
      throw fault(file, map.where,
                  "has no entry for e = " + text(e[i]) + "; expected one for each e of the grid");
    tau_max.push_back(*found[i]);
  }
  return tau_max;
}

std::string listed(const std::vector<double>& numbers) {
  std::string all;
  for (const double number : numbers) all += (all.empty() ? "" : ", ") + text(number);
  return all;
}

// Both are rounded: what differs by less than this is the same place. [relative]
bool is_multiple(double tau, double interval) {
  constexpr double rounding = 1e-9;
  return std::abs(tau / interval - std::round(tau / interval)) <=
         rounding * std::max(1.0, tau / interval);
}

void sampled(const std::string& file, const Source& source, const std::vector<double>& tau_max) {
  for (const Placed& item : items(source["sample_every"])) {
    const double shortest = *std::min_element(tau_max.begin(), tau_max.end());
    if (item.value.get<double>() > shortest)
      throw fault(file, item.where,
                  shown(item.value) +
                      " is longer than the run; expected at most tau_max = " + text(shortest));
    const double longest = *std::max_element(tau_max.begin(), tau_max.end());
    if (const double samples = longest / item.value.get<double>(); samples > most_samples)
      throw fault(file, item.where,
                  shown(item.value) + " makes " + rounded(samples) +
                      " samples of a run to tau_max = " + text(longest) +
                      "; expected at most 10^7, sample_every >= " + text(longest / most_samples));
  }
}

// Collisions are counted in whole numbers that a double holds exactly.
void can_count_collisions(const std::string& file, const Source& source,
                          const std::vector<double>& tau_max) {
  const double longest = *std::max_element(tau_max.begin(), tau_max.end());
  for (const double N : source.list<double>("N"))
    if (const double collisions = 0.5 * longest * N; collisions > most_collisions)
      throw fault(file, source["tau_max"].where,
                  text(longest) + " makes " + rounded(collisions) + " collisions of " + text(N) +
                      " particles; expected at most 2^53 = 9.01e+15, tau_max below " +
                      rounded(2 * most_collisions / N));
}

// Profiles and fields belong to samples within the run.
void in_step(const std::string& file, const Source& source, const std::vector<double>& tau_max) {
  const auto names = source.observables();
  const double longest = *std::max_element(tau_max.begin(), tau_max.end());
  const auto belongs = [&](const Placed& item) {
    const double tau = item.value.get<double>();
    if (tau > longest)
      throw fault(file, item.where,
                  text(tau) + " is beyond the run; expected at most tau_max = " + text(longest));
    for (const double sample_every : source.list<double>("sample_every"))
      if (!is_multiple(tau, sample_every))
        throw fault(file, item.where,
                    text(tau) + " falls between samples; expected a multiple of sample_every = " +
                        text(sample_every));
  };
  if (std::any_of(names.begin(), names.end(), is_profile)) belongs(source["profiles_every"]);
  std::set<double> waiting_times;
  for (const Placed& item : items(source["observables"])) {
    const auto waiting = waiting_time(item.value.get<std::string>());
    if (!waiting) continue;
    belongs({.where = item.where, .value = *waiting});
    if (waiting_times.insert(*waiting).second && waiting_times.size() > most_waiting_times)
      throw fault(file, item.where,
                  shown(item.value) + " is one waiting time too many; expected at most " +
                      std::to_string(most_waiting_times));
  }
  if (std::none_of(names.begin(), names.end(), is_field)) return;
  const auto moments = source.find("fields_at");
  if (!moments)
    throw fault(file, source.where(),
                "has no \"fields_at\", and lists fields among its observables; expected " +
                    description("fields_at"));
  for (const Placed& item : items(*moments)) belongs(item);
}

void on_axis_of_tau(const std::string& file, const Source& source, const Placed& moments,
                    double longest) {
  const auto within_run = [&](const Placed& item) {
    if (item.value.get<double>() > longest)
      throw fault(
          file, item.where,
          shown(item.value) + " is beyond the run; expected at most tau_max = " + text(longest));
  };
  if (moments.value.is_object()) {
    if (!moments.value.contains("log"))
      throw fault(file, moments.where,
                  "has no \"log\"; expected so many moments a decade, as in {\"log\": 20}");
    if (moments.value.contains("from")) within_run({moments.where / "from", moments.value["from"]});
    return;
  }
  auto listed = items(moments);
  for (const Placed& item : listed) within_run(item);
  std::ranges::sort(listed, {}, [](const Placed& item) { return item.value.get<double>(); });
  for (const double N : source.list<double>("N"))
    for (std::size_t k = 1; k < listed.size(); ++k) {
      const double before = listed[k - 1].value.get<double>(), now = listed[k].value.get<double>();
      if (std::ceil(now * N / 2) == std::ceil(before * N / 2))
        throw fault(file, listed[k].where,
                    text(now) + " is the same collision of " + text(N) + " particles as " +
                        text(before) + "; expected 2/N = " + rounded(2 / N) +
                        " between two moments");
    }
}

// Moments lie within the run, and collisions lie between them.
void has_moments(const std::string& file, const Source& source, const std::vector<double>& tau_max,
                 const std::string& key) {
  const auto placed = source.find(key);
  if (!placed) return;
  const double longest = *std::max_element(tau_max.begin(), tau_max.end());
  const bool has_axes = placed->value.is_object() &&
                        (placed->value.contains("tau") || placed->value.contains("time"));
  if (!has_axes) return on_axis_of_tau(file, source, *placed, longest);
  for (const char* of_tau_alone : {"log", "from"})
    if (placed->value.contains(of_tau_alone))
      throw fault(file, placed->where / of_tau_alone,
                  "stands beside \"tau\" or \"time\"; expected it within one of them, as in "
                  "{\"tau\": {\"log\": 20}}");
  if (placed->value.contains("tau"))
    on_axis_of_tau(file, source, {placed->where / "tau", placed->value["tau"]}, longest);
}

}  // namespace

std::vector<double> tau_max_of_each_e(const std::string& file, const Source& source) {
  const Placed placed = source["tau_max"];
  const auto e = source.e();
  if (placed.value.is_number())
    return std::vector<double>(std::max<std::size_t>(e.size(), 1), placed.value.get<double>());
  if (e.empty())
    throw fault(file, placed.where,
                "is a map from e, which no gas of this grid has; expected a number");
  return matched(file, placed, e);
}

void must_have_no_strays(const std::string& file, const std::vector<Source>& sources) {
  for (const Source& one : sources) {
    const Placed placed = one["tau_max"];
    if (!placed.value.is_object()) continue;
    std::vector<double> asked;
    for (const Source& source : sources)
      if (source["tau_max"].where == placed.where) {
        const auto e = source.e();
        asked.insert(asked.end(), e.begin(), e.end());
      }
    for (const auto& [key, value] : placed.value.items())
      if (std::count(asked.begin(), asked.end(), restitution(file, placed.where, key)) == 0)
        throw fault(file, placed.where / key,
                    "there is no such e; expected the e of this grid: " + listed(asked));
  }
}

void must_collide_between_samples(const std::string& file, const Source& source) {
  for (const double N : source.list<double>("N"))
    for (const double sample_every : source.list<double>("sample_every"))
      if (sample_every * N < 2)
        throw fault(file, source["sample_every"].where,
                    text(sample_every) + " is less than one collision of " + text(N) +
                        " particles; expected at least 2/N = " + rounded(2 / N));
}

void must_lie_within_run(const std::string& file, const Source& source,
                         const std::vector<double>& tau_max) {
  sampled(file, source, tau_max);
  can_count_collisions(file, source, tau_max);
  in_step(file, source, tau_max);
  for (const char* key : {"sample_at", "snapshots_at"}) has_moments(file, source, tau_max, key);
}

}  // namespace haff::schema
