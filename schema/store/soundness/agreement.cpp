// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/store/soundness/agreement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "schema/rows/sample_columns.hpp"
#include "schema/store/rows/checked_rows.hpp"
#include "schema/store/rows/job_rows.hpp"
#include "schema/store/soundness/contradiction.hpp"

namespace haff::schema {

namespace {

// Columns that are means over the time since the sample before. Two jobs have the same values only
// if they sample at the same tau.
constexpr std::array<std::string_view, 3> of_intervals{"gamma_ratio", "collision_rate", "pressure"};

struct Disagreement {
  const char* column;
  double first, second;
};

bool is_same(std::string_view column, double first, double second) {
  return std::abs(first - second) <=
         last_digits(column) * std::max(std::abs(first), std::abs(second));
}

// A column that only one of the two has was not observed, or not known to the program, when the
// other was taken.
std::optional<Disagreement> disagreement(const Sample& first, const Sample& second,
                                         bool has_same_intervals) {
  if (first.time != second.time) return Disagreement{"time", first.time, second.time};
  for (const SampleColumn& column : sample_columns) {
    const auto &a = first.*column.value, &b = second.*column.value;
    if (!a || !b) continue;
    if (!has_same_intervals && std::ranges::find(of_intervals, column.name) != of_intervals.end())
      continue;
    if (!is_same(column.name, *a, *b)) return Disagreement{column.name, *a, *b};
  }
  return std::nullopt;
}

std::vector<Sample> samples_of(Database& database, std::int64_t job_id) {
  Prepared row(database, "SELECT * FROM samples WHERE job_id = ? ORDER BY tau");
  row.bind(1, job_id);
  std::vector<Sample> samples;
  while (row.executeStep()) samples.push_back(sample(row));
  return samples;
}

bool is_as_written(Database& database, std::int64_t job_id) {
  const auto written = database.digests().stored(job_id, Part::samples);
  return !written || *written == database.digests().present(job_id, Part::samples);
}

void must_agree(Database& database, std::int64_t job_id, const std::vector<Sample>& samples,
                std::int64_t other_id, bool has_same_intervals) {
  if (!is_as_written(database, other_id)) return;  // what is wrong is known: campaign verify
  auto now = samples.begin();
  for (const Sample& before : samples_of(database, other_id)) {
    now = std::find_if(now, samples.end(),
                       [&](const Sample& sample) { return sample.tau >= before.tau; });
    if (now == samples.end()) return;
    if (now->tau != before.tau) continue;
    if (const auto found = disagreement(before, *now, has_same_intervals))
      throw Damage(fmt::format(
          "job {}: the sample at tau = {} {}: {} is {:.17g}, and {:.17g} in job {}, which has the "
          "same physics; one of the two computations was disturbed. See: campaign verify "
          "--recompute {}",
          job_id, before.tau, came_out_different, found->column, found->second, found->first,
          other_id, other_id));
  }
}

}  // namespace

void must_agree(Database& database, std::int64_t job_id, const Sample& again) {
  Prepared row(database, "SELECT * FROM samples WHERE job_id = ? AND tau = ?");
  row.bind(1, job_id);
  row.bind(2, again.tau);
  row.executeStep();
  if (const auto found = disagreement(sample(row), again, true))
    throw Damage(fmt::format(
        "job {}: the sample at tau = {} {}: {} was {:.17g}, and is {:.17g} now; one of the two "
        "computations was disturbed, or the program that made the first has changed",
        job_id, again.tau, came_out_different, found->column, found->first, found->second));
}

void must_agree(Database& database, std::int64_t job_id, const Snapshot& again, std::uint64_t sum) {
  Prepared row(database, "SELECT checksum FROM snapshots WHERE job_id = ? AND time = ?");
  row.bind(1, job_id);
  row.bind(2, again.time);
  row.executeStep();
  if (row.getColumn(0).getInt64() != static_cast<std::int64_t>(sum))
    throw Damage(fmt::format(
        "job {}: the snapshot at tau = {} {}; one of the two computations was disturbed, or the "
        "program that made the first has changed",
        job_id, again.tau, came_out_different));
}

// Jobs of one gas start from one equilibration, so that they are found by its index, and few.
void must_agree_with_same_physics(Database& database, std::int64_t job_id) {
  Prepared others(database, R"(
    SELECT other.job_id,
           other.sample_every = own.sample_every AND other.sample_at IS own.sample_at
    FROM jobs AS own JOIN jobs AS other ON other.equilibration_id = own.equilibration_id
    WHERE own.job_id = ? AND other.job_id <> own.job_id AND other.status = 'done'
          AND other.e IS own.e AND other.effects = own.effects AND other.start IS own.start
          AND other.physics_version IS own.physics_version)");
  others.bind(1, job_id);
  std::optional<std::vector<Sample>> samples;
  while (others.executeStep()) {
    if (!samples) samples = samples_of(database, job_id);
    must_agree(database, job_id, *samples, others.getColumn(0).getInt64(),
               others.getColumn(1).getInt() == 1);
  }
}

}  // namespace haff::schema
