#include "campaign/commands/verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <variant>

#include "analysis/theory/cooling.hpp"
#include "campaign/base/command_text.hpp"
#include "campaign/base/exit_code.hpp"
#include "campaign/base/job_text.hpp"
#include "campaign/base/number_text.hpp"
#include "campaign/base/output.hpp"
#include "campaign/base/printable.hpp"
#include "campaign/base/text_table.hpp"
#include "campaign/job/measurement.hpp"
#include "campaign/job/timetable.hpp"
#include "campaign/state/model.hpp"
#include "campaign/state/restore.hpp"
#include "engine/simulation.hpp"
#include "engine/soundness.hpp"

namespace haff::campaign {
namespace {

using schema::JobRow;
using schema::Reader;
using schema::Sample;

// A sample and a checkpoint at the same tau sum the same velocities; the order of the sum may
// differ between two machines or versions. [relative]
constexpr double energy_rounding = 1e-11;

// An elastic gas keeps its energy but for rounding, some 1e-16 a collision at random. [relative]
constexpr double elastic_drift = 1e-9;

using Faults = std::vector<std::string>;

// (2/d) of the energy per particle, of translation and, in rough spheres, rotation: what collisions
// cannot make more.
double total(const Sample& sample, const schema::Job& job) {
  return *sample.temperature +
         sample.rotational_temperature.value_or(0) * axes_of_rotation(job.d) / job.d;
}

double total(const engine::State& state, const schema::Job& job) {
  const auto mixture = mixture_in(state);
  const auto mass_of = [&](std::uint32_t id) { return mixture ? mixture->mass_of(id) : 1; };
  double sum = 0;
  for (std::size_t i = 0; i < state.id.size(); ++i) {
    const auto& v = state.velocity[i];
    sum += mass_of(state.id[i]) * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  }
  const engine::Model model = model_of(job);
  const auto roughness = model.effects.find("roughness");
  const auto spin = state.memory.find("spin");
  if (roughness != model.effects.end() && spin != state.memory.end())
    for (std::size_t i = 0; i < spin->second.size(); ++i)
      sum += mass_of(static_cast<std::uint32_t>(i / 3)) * roughness->second.at("q") *
             spin->second[i] * spin->second[i];
  const double components = static_cast<double>(job.d) * state.particles();
  return std::ldexp(sum / components, -2 * state.exponent);
}

// Only who is heated may grow warmer.
bool is_heated(const schema::Job& job) {
  return job.effects.find("\"thermostat\"") != std::string::npos;
}

void check_order(const std::vector<Sample>& samples, const JobRow& row, Faults& faults) {
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const Sample& now = samples[k];
    const double expected = sample_tau(row.job.sample_every, static_cast<std::int64_t>(k));
    if (now.tau != expected) {
      faults.push_back(fmt::format("the sample at tau = {} is missing", expected));
      return;
    }
    if (k == 0) continue;
    const Sample& before = samples[k - 1];
    if (now.time < before.time)
      faults.push_back(fmt::format("time runs backwards at tau = {}", now.tau));
    if (now.temperature && before.temperature && !is_heated(row.job) &&
        total(now, row.job) > total(before, row.job) * (1 + elastic_drift))
      faults.push_back(fmt::format("the gas grows warmer at tau = {}", now.tau));
  }
}

void check_elastic(const std::vector<Sample>& samples, const JobRow& row, Faults& faults) {
  const double expected = analysis::initial_temperature(row.job.d);
  for (const Sample& sample : samples)
    if (sample.temperature &&
        !(std::abs(*sample.temperature - expected) <= elastic_drift * expected))
      faults.push_back(
          fmt::format("temperature {:.17g} at tau = {} of an elastic gas (expected {})",
                      *sample.temperature, sample.tau, expected));
}

void check_complete(const Reader& store, const JobRow& row, const std::vector<Sample>& samples,
                    Faults& faults) {
  const std::int64_t expected = sample_count(row.job.sample_every, row.tau_max);
  if (static_cast<std::int64_t>(samples.size()) < expected)
    faults.push_back(fmt::format("done, but has {} of {} samples", samples.size(), expected));
  if (row.job.kind == schema::Kind::equilibration) {
    if (!samples.empty() && !is_equilibrated(samples.back(), row.job))
      faults.emplace_back("done, but not in equilibrium at its end");
    return;
  }
  const auto stored = store.results(row.job_id);
  if (!stored)
    faults.emplace_back("done, but has no results");
  else if (*stored != results(samples, row.job))
    faults.emplace_back("its results do not follow from its samples");
}

// The energy in a checkpoint against the sample at the same tau, or, in a gas that only cools, the
// samples around it.
void check_energy(const engine::State& state, const JobRow& row, const std::vector<Sample>& samples,
                  Faults& faults) {
  const double temperature = total(state, row.job);
  for (const Sample& sample : samples) {
    if (!sample.temperature) continue;
    const std::int64_t collisions = engine::collisions_at(sample.tau, row.job.particles);
    if (collisions != state.collisions && is_heated(row.job)) continue;
    const double excess = temperature / total(sample, row.job) - 1;
    const bool agrees = collisions < state.collisions   ? excess <= energy_rounding
                        : collisions > state.collisions ? excess >= -energy_rounding
                                                        : std::abs(excess) <= energy_rounding;
    if (agrees) continue;
    faults.push_back(
        fmt::format("the checkpoint after {} collisions has temperature {:.17g}, the sample at tau "
                    "= {} {:.17g}",
                    state.collisions, temperature, sample.tau, total(sample, row.job)));
    return;
  }
}

// Events in the past come from rounding, if at all: fewer than one in so many collisions.
constexpr double past_events_per_collision = 1e-6;

// Periods may be so much longer than expected in gases of a few particles. The engine itself knows
// how long each was.
constexpr double slowest_period = 1000;

void check_invariants(const Reader& store, const JobRow& row, Faults& faults) {
  const auto seen = store.invariants(row.job_id);
  if (!seen) return;  // not yet begun, or computed before they were counted
  const double closest = 1 - seen->largest_overlap;
  const auto wrong =
      engine::violation({.closest2 = closest * closest,
                         .past_events = seen->past_events,
                         .unresolved_collisions = seen->watchdog_trips,
                         .energy_mismatch = seen->energy_mismatch,
                         .momentum_removed = seen->momentum_removed},
                        engine::allowed_overlap(row.job.n, slowest_period, row.job.d));
  if (wrong) faults.push_back(*wrong);
  const auto collisions = static_cast<double>(row.progress.collisions);
  if (static_cast<double>(seen->past_events) > past_events_per_collision * collisions + 1)
    faults.push_back(
        fmt::format("{} events lay in the past when their turn came", seen->past_events));
  if (row.status == schema::Status::done &&
      seen->watchdog_trips >= engine::unresolved_collisions_of_a_collapse)
    faults.push_back(fmt::format("done, but the watchdog tripped {} times", seen->watchdog_trips));
}

bool must_have_checkpoint(const JobRow& row) {
  return row.job.kind == schema::Kind::equilibration && row.status == schema::Status::done;
}

void check_checkpoint(const Reader& store, const JobRow& row, Faults& faults) {
  const auto checkpoint = store.checkpoint(row.job_id);
  if (!checkpoint) {
    if (must_have_checkpoint(row)) faults.emplace_back("done, but its state is gone");
    return;
  }
  const engine::State state = restore(*checkpoint, row.job);
  // Read after the checkpoint: of a job that is being run there may be more by now, never less.
  check_energy(state, row, store.samples(row.job_id), faults);
}

std::map<std::int64_t, std::string> stored_identities(const Reader& store) {
  auto rows = store.query("SELECT job_id, identity FROM jobs");
  std::map<std::int64_t, std::string> identities;
  while (const auto row = rows.next())
    identities[std::get<std::int64_t>((*row)[0])] = std::get<std::string>((*row)[1]);
  return identities;
}

Faults all_faults(const Reader& store) {
  Faults faults = store.faults();
  const auto identities = stored_identities(store);
  for (const JobRow& row : store.jobs()) {
    const std::string job = fmt::format("job {} ({}): ", row.job_id, describe(row.job));
    if (const auto found = identities.find(row.job_id);
        found != identities.end() && found->second != identity(row.job))
      faults.push_back(job + "its columns do not make up its identity");
    for (const std::string& fault : faults_of(store, row)) faults.push_back(job + fault);
  }
  return faults;
}

std::string size_text(const Reader& store) {
  auto rows = store.query(
      "SELECT (SELECT count(*) FROM jobs), (SELECT count(*) FROM samples), "
      "(SELECT count(*) FROM checkpoints)");
  const auto counts = rows.next().value();
  const auto count = [&](std::size_t k) { return count_text(std::get<std::int64_t>(counts[k])); };
  return fmt::format("{} jobs, {} samples, {} checkpoints", count(0), count(1), count(2));
}

}  // namespace

Faults faults_of(const Reader& store, const JobRow& row) {
  Faults faults;
  try {
    check_checkpoint(store, row, faults);
  } catch (const schema::Damage& damage) {
    faults.push_back(fmt::format("its checkpoint is damaged: {}", damage.what()));
  } catch (const DamagedCheckpoint& damage) {
    faults.push_back(fmt::format("its checkpoint is damaged: {}", damage.what()));
  }
  check_invariants(store, row, faults);
  const std::vector<Sample> samples = store.samples(row.job_id);
  check_order(samples, row, faults);
  if (row.job.kind == schema::Kind::equilibration) check_elastic(samples, row, faults);
  if (row.status == schema::Status::done) check_complete(store, row, samples, faults);
  return faults;
}

int verify(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) static_cast<void>(Reader{path});  // throws: make it first
  Faults faults;
  std::string size;
  try {
    const Reader store(path);
    faults = all_faults(store);
    size = size_text(store);
  } catch (const schema::StoreError& error) {
    faults.emplace_back(error.what());
  }
  for (const std::string& fault : faults) say("{}\n", printable(fault));
  if (faults.empty()) {
    say("{}: sound ({})\n", path.string(), size);
    return exit_complete;
  }
  say("{}: {} fault{} found. Damaged checkpoints are never used; {} computes their jobs "
      "again\n",
      path.string(), faults.size(), faults.size() == 1 ? "" : "s", command_text("retry", path));
  return exit_failed;
}

}  // namespace haff::campaign
