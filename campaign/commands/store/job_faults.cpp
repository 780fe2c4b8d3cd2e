// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/commands/store/job_faults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <set>

#include "analysis/theory/cooling.hpp"
#include "campaign/job/measurement.hpp"
#include "campaign/job/timetable.hpp"
#include "campaign/state/energy.hpp"
#include "campaign/state/restore.hpp"
#include "engine/soundness.hpp"

namespace haff::campaign {
namespace {

using schema::JobRow;
using schema::Reader;
using schema::Sample;

using Texts = std::vector<std::string>;

// At tau_c the interpolated ln(T/T_Haff) reaches ln 2, and logarithms of the C library differ in
// their last digits between two processors. The slope there is about 1/tau_c, so that 1e-16 in the
// logarithm makes 1e-15 in tau_c, far below this tolerance. [relative]
constexpr double digits_of_logarithms = 1e-10;

void check_order(const std::vector<Sample>& samples, const JobRow& row, Texts& faults) {
  SampleTaus expected(row.job);
  for (std::size_t k = 0; k < samples.size(); ++k, expected.advance()) {
    const Sample& now = samples[k];
    if (now.tau != expected.tau()) {
      faults.push_back(fmt::format("the sample at tau = {} is missing", expected.tau()));
      return;
    }
    if (k == 0) continue;
    const Sample& before = samples[k - 1];
    if (now.time < before.time)
      faults.push_back(fmt::format("time runs backwards at tau = {}", now.tau));
    if (now.temperature && before.temperature && !is_heated(row.job) &&
        total_energy(now, row.job) >
            total_energy(before, row.job) * (1 + elastic_drift) + smallest_energy)
      faults.push_back(fmt::format("the gas grows warmer at tau = {}", now.tau));
  }
}

void check_elastic(const std::vector<Sample>& samples, const JobRow& row, Texts& faults) {
  const double expected = analysis::initial_temperature(row.job.d);
  for (const Sample& sample : samples)
    if (sample.temperature &&
        !(std::abs(*sample.temperature - expected) <= elastic_drift * expected))
      faults.push_back(
          fmt::format("temperature {:.17g} at tau = {} of an elastic gas (expected {})",
                      *sample.temperature, sample.tau, expected));
}

bool agree(const std::optional<double>& one, const std::optional<double>& other) {
  if (!one || !other) return one.has_value() == other.has_value();
  return std::abs(*one - *other) <= digits_of_logarithms * std::abs(*other);
}

bool agree(const schema::Results& one, const schema::Results& other) {
  return agree(one.tau_c, other.tau_c) && agree(one.time_c, other.time_c);
}

void check_complete(const Reader& store, const JobRow& row, const std::vector<Sample>& samples,
                    Texts& faults) {
  const schema::Start& start = row.job.start;
  if (row.job.kind == schema::Kind::equilibration && !start.is_equilibrated()) {
    if (start.kind == schema::Start::Kind::crystal && samples.empty())
      faults.emplace_back("done, but has no sample");
    return;
  }
  const std::int64_t expected = sample_count(row.job, row.tau_max);
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
  else if (!agree(*stored, results(samples, row.job)))
    faults.emplace_back("its results do not follow from its samples");
}

// Rounding alone puts events into the past: at most one in this many collisions.
constexpr double past_events_per_collision = 1e-6;

// In gases of a few particles, periods may be longer than expected by this factor. The engine
// itself knows how long each one was.
constexpr double slowest_period = 1000;

void check_invariants(const Reader& store, const JobRow& row, Texts& faults) {
  const auto seen = store.invariants(row.job_id);
  if (!seen) return;  // not yet begun, or computed before they were counted
  const double closest = 1 - seen->largest_overlap;
  const auto wrong =
      engine::violation({.closest2 = closest * closest,
                         .past_events = seen->past_events,
                         .unresolved_collisions = seen->unresolved_collisions,
                         .energy_mismatch = seen->energy_mismatch,
                         .momentum_removed = seen->momentum_removed},
                        engine::allowed_overlap(row.job.n, slowest_period, row.job.d));
  if (wrong) faults.push_back(*wrong);
  const auto collisions = static_cast<double>(row.progress.collisions);
  if (static_cast<double>(seen->past_events) > past_events_per_collision * collisions + 1)
    faults.push_back(
        fmt::format("{} events lay in the past when their turn came", seen->past_events));
  if (row.status == schema::Status::done &&
      seen->unresolved_collisions >= engine::unresolved_collisions_of_a_collapse)
    faults.push_back(fmt::format("done, but with {} collisions too slow to be resolved",
                                 seen->unresolved_collisions));
}

// Rows that are not as they were written are examined no further, except samples.
struct Parts {
  std::set<schema::Part> wrong;

  bool are_wrong(std::initializer_list<schema::Part> parts) const {
    return std::any_of(parts.begin(), parts.end(),
                       [&](schema::Part part) { return wrong.contains(part); });
  }
};

Parts check_digests(const Reader& store, const JobRow& row, JobFaults& faults) {
  const schema::DigestsOfJob digests = store.digests(row.job_id);
  faults.lacks_digests = !digests.without.empty();
  for (const schema::Part part : digests.wrong)
    faults.rows.push_back(
        part == schema::Part::jobs
            ? std::string("its row of the table jobs is not as it was written (its digest)")
            : fmt::format("its {} are not as they were written (their digest)", name(part)));
  return {{digests.wrong.begin(), digests.wrong.end()}};
}

// Whether there is a state; throws as restore() does if it is damaged.
bool is_restorable(const Reader& store, const JobRow& row) {
  const auto checkpoint = store.checkpoint(row.job_id);
  if (checkpoint) restore(*checkpoint, row.job);
  return checkpoint.has_value();
}

void check_state(const Reader& store, const JobRow& row, const Parts& parts, JobFaults& faults) {
  const bool must_have_state =
      row.job.kind == schema::Kind::equilibration && row.status == schema::Status::done;
  if (row.starts_over) return;  // known, and to be computed again
  try {
    // It is compared with its samples, unless these are wrong.
    const bool has_state = parts.are_wrong({schema::Part::samples})
                               ? is_restorable(store, row)
                               : stored_state(store, row.job_id, row.job).has_value();
    if (!has_state && must_have_state) faults.state = "done, but its state is gone";
  } catch (const schema::Damage& damage) {
    faults.state = fmt::format("its checkpoint is damaged: {}", damage.what());
  } catch (const DamagedCheckpoint& damage) {
    faults.state = fmt::format("its checkpoint is damaged: {}", damage.what());
  } catch (const NewerCheckpoint& newer) {
    faults.newer = newer.what();
  }
}

// Checks that they can be read: as many values as the cells need, and finite points.
void check_views(const Reader& store, const JobRow& row, const Parts& parts, Texts& faults) {
  if (parts.are_wrong({schema::Part::profiles, schema::Part::fields})) return;
  try {
    for (const schema::FieldName& field : store.fields(row.job_id))
      store.field(row.job_id, field.name, field.tau);
    for (const char* name : {"rho", "G_parallel", "G_perpendicular", "S"})
      store.profiles(row.job_id, name);
  } catch (const schema::Damage& damage) {
    faults.emplace_back(damage.what());
  }
}

// Checks that all are there up to the newest state, like the job's rows, and can be exported.
void check_snapshots(const Reader& store, const JobRow& row, const Parts& parts, Texts& faults) {
  if (row.job.snapshots_at.empty() || parts.are_wrong({schema::Part::snapshots})) return;
  std::int64_t at_tau = 0;
  for (const schema::SnapshotInfo& info : store.snapshots(row.job_id)) try {
      snapshot_state(store, row.job_id, row.job, info.time);
      const double next = row.job.snapshots_at.tau.next(std::nextafter(info.tau, -1.0));
      at_tau += next == info.tau ? 1 : 0;
    } catch (const schema::Damage& damage) {
      faults.emplace_back(damage.what());
    } catch (const DamagedCheckpoint& damage) {
      faults.emplace_back(damage.what());
    }
  const std::int64_t expected = count_through(row.job.snapshots_at.tau, row.tau_max);
  if (row.status == schema::Status::done && at_tau < expected)
    faults.push_back(fmt::format("done, but has {} of {} snapshots", at_tau, expected));
}

void check_rows(const Reader& store, const JobRow& row, const Parts& parts, Texts& faults) {
  try {
    if (!parts.are_wrong({schema::Part::invariants})) check_invariants(store, row, faults);
    const std::vector<Sample> samples = store.samples_unchecked(row.job_id);
    check_order(samples, row, faults);
    if (row.job.kind == schema::Kind::equilibration) check_elastic(samples, row, faults);
    if (row.status == schema::Status::done && !parts.are_wrong({schema::Part::results}))
      check_complete(store, row, samples, faults);
  } catch (const schema::Damage& damage) {
    faults.emplace_back(damage.what());
  }
}

}  // namespace

JobFaults faults_of(const Reader& store, const JobRow& row) {
  JobFaults faults;
  const Parts parts = check_digests(store, row, faults);
  check_state(store, row, parts, faults);
  check_rows(store, row, parts, faults.rows);
  check_views(store, row, parts, faults.rows);
  check_snapshots(store, row, parts, faults.rows);
  return faults;
}

}  // namespace haff::campaign
