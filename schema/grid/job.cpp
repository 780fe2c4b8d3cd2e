// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/grid/job.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "schema/grid/effects.hpp"
#include "schema/grid/observables.hpp"

namespace haff::schema {

namespace {

// The shortest text that reads back as the same double; zero has no sign.
std::string real(double value) {
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value + 0.0).ptr;
  return {text.data(), end};
}

}  // namespace

std::string_view name(Kind kind) {
  return kind == Kind::equilibration ? "equilibration" : "cooling";
}

Kind kind_named(std::string_view text) {
  for (const Kind kind : {Kind::equilibration, Kind::cooling})
    if (name(kind) == text) return kind;
  throw std::invalid_argument("no kind of job is called " + std::string(text));
}

std::string_view name(Status status) {
  return statuses[static_cast<std::size_t>(status)].name;
}

Status status_named(std::string_view text) {
  for (const StatusEntry& entry : statuses)
    if (entry.name == text) return entry.status;
  throw std::invalid_argument("no status is called " + std::string(text));
}

Job equilibration_of(const Job& cooling) {
  Job job = cooling;
  job.kind = Kind::equilibration;
  job.e = 1;
  job.sample_every = equilibration_sample_every;
  job.effects = effects_of_equilibration(cooling.effects);
  job.observables = {"laguerre", "temperature"};
  job.profiles_every = std::nullopt;
  job.fields_at.clear();
  job.sample_at = {};
  job.snapshots_at = {};
  if (job.start.is_equilibrated()) job.start = {};
  if (job.start.kind == Start::Kind::file) job.seed = 0;
  return job;
}

double tau_max_of_equilibration(const Job& equilibration) {
  return std::max(equilibration.equilibrate, equilibration_sample_every);
}

Job unobserved(Job job) {
  job.observables.clear();
  job.profiles_every = std::nullopt;
  job.fields_at.clear();
  job.snapshots_at = {};
  return job;
}

Job unsampled(Job job) {
  job.sample_every = 1;
  job.sample_at = {};
  return unobserved(std::move(job));
}

std::string identity(const Job& job) {
  return R"({"d":)" + std::to_string(job.d) +            //
         R"(,"e":)" + (job.e ? real(*job.e) : "null") +  //
         R"(,"effects":)" + job.effects.text() +         //
         R"(,"equilibrate":)" + real(job.equilibrate) +  //
         (job.fields_at.empty() ? "" : R"(,"fields_at":)" + fields_at_text(job.fields_at)) +
         R"(,"kind":")" + std::string(name(job.kind)) +              //
         R"(","n":)" + real(job.n) +                                 //
         R"(,"observables":)" + observables_text(job.observables) +  //
         R"(,"particles":)" + std::to_string(job.particles) +        //
         (job.profiles_every ? R"(,"profiles_every":)" + real(*job.profiles_every) : "") +
         (job.sample_at.empty() ? "" : R"(,"sample_at":)" + schedule_text(job.sample_at)) +
         R"(,"sample_every":)" + real(job.sample_every) +  //
         R"(,"seed":)" + std::to_string(job.seed) +        //
         (job.snapshots_at.empty() ? "" : R"(,"snapshots_at":)" + schedule_text(job.snapshots_at)) +
         (job.start.is_uniform() ? "" : R"(,"start":)" + start_text(job.start)) + "}";
}

bool cools_by_haff(const Job& job) {
  return job.e.has_value() && !beyond_haffs_law(job.effects) && !job.start.is_driven_apart();
}

std::string series_identity(Job job) {
  job.seed = 0;
  return identity(job);
}

bool is_at_interval(const Job& job, double tau) {
  return job.sample_at.tau.empty() || tau == std::round(tau / job.sample_every) * job.sample_every;
}

bool is_profile(std::string_view observable) {
  const Observable* found = find_observable(observable);
  return found != nullptr && found->taken == Taken::with_profiles;
}

bool is_field(std::string_view observable) {
  const Observable* found = find_observable(observable);
  return found != nullptr && found->taken == Taken::with_fields;
}

std::string observables_text(const std::vector<std::string>& observables) {
  auto sorted = observables;
  std::sort(sorted.begin(), sorted.end());
  return nlohmann::json(sorted).dump();
}

std::vector<std::string> observables_in(const std::string& text) {
  return nlohmann::json::parse(text).get<std::vector<std::string>>();
}

std::string fields_at_text(const std::vector<double>& fields_at) {
  std::string text;
  for (const double tau : fields_at) text += (text.empty() ? "" : ",") + real(tau);
  return "[" + text + "]";
}

std::vector<double> fields_at_in(const std::string& text) {
  return nlohmann::json::parse(text).get<std::vector<double>>();
}

}  // namespace haff::schema
