// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/store/rows/checked_rows.hpp"

#include <cstring>
#include <exception>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "schema/rows/sample_columns.hpp"

namespace haff::schema {

namespace {

constexpr std::int64_t most_particles = std::numeric_limits<std::uint32_t>::max();

// The value that `read` makes of a text; `write` must make the same text of it.
template <class Read, class Write>
auto canonical(const SQLite::Statement& row, const char* column, Read&& read, Write&& write) {
  const std::string stored = text(row, column);
  try {
    auto value = read(stored);
    if (write(value) == stored) return value;
  } catch (const std::exception&) {  // not JSON, or other JSON than expected
  }
  throw BadValue(std::string("the column ") + column + " is not as campaign writes it");
}

Effects effects(const SQLite::Statement& row) {
  return canonical(
      row, "effects", [](const std::string& json) { return Effects(json); },
      [](const Effects& all) { return all.text(); });
}

std::vector<double> fields_at(const SQLite::Statement& row) {
  if (row.isColumnNull("fields_at")) return {};
  return canonical(row, "fields_at", fields_at_in, fields_at_text);
}

Schedule schedule(const SQLite::Statement& row, const char* column) {
  if (row.isColumnNull(column)) return {};
  return canonical(row, column, schedule_in, schedule_text);
}

Start start(const SQLite::Statement& row) {
  if (row.isColumnNull("start")) return {};
  return canonical(row, "start", start_in, start_text);
}

// A kind or a status by its name.
template <class Named>
auto named(const SQLite::Statement& row, const char* column, Named&& known) {
  try {
    return known(text(row, column));
  } catch (const std::invalid_argument& unknown) {
    throw BadValue(unknown.what());
  }
}

// More samples or collisions than any run makes; with still more, whole numbers would overflow.
void must_be_countable(const Job& job, double tau_max) {
  constexpr auto most = static_cast<double>(largest_whole);
  if (tau_max / job.sample_every > most || tau_max * job.particles > most)
    throw BadValue("the columns tau_max, sample_every and particles make more than any run can do");
}

}  // namespace

Job job_of(const SQLite::Statement& row) {
  Job job{.kind = named(row, "kind", kind_named),
          .d = static_cast<int>(integer(row, "d", 2, 3)),
          .e = optional_real(row, "e"),
          .n = positive(row, "n"),
          .particles = static_cast<std::uint32_t>(integer(row, "particles", 2, most_particles)),
          .seed = static_cast<std::uint64_t>(integer(row, "seed", 0, largest_whole)),
          .start = start(row),
          .equilibrate = not_negative(row, "equilibrate"),
          .sample_every = positive(row, "sample_every"),
          .sample_at = schedule(row, "sample_at"),
          .effects = effects(row),
          .observables = canonical(row, "observables", observables_in, observables_text),
          .profiles_every = optional(row, "profiles_every", positive),
          .fields_at = fields_at(row),
          .snapshots_at = schedule(row, "snapshots_at")};
  if (job.e && !(*job.e >= 0 && *job.e <= 1))
    throw BadValue("the column e holds a number that is not between 0 and 1");
  return job;
}

JobRow job_row(const SQLite::Statement& row) {
  JobRow job{.job_id = integer(row, "job_id"),
             .job = job_of(row),
             .tau_max = positive(row, "tau_max"),
             .checkpoint_every = positive(row, "checkpoint_every"),
             .equilibration_id = optional(
                 row, "equilibration_id",
                 [](const auto& from, const char* column) { return integer(from, column); }),
             .status = named(row, "status", status_named),
             .attempts = static_cast<int>(integer(row, "attempts", 0, max_attempts)),
             .error = optional_text(row, "error"),
             .progress = progress_of(row),
             .expected_cpu_seconds = optional(row, "expected_cpu_seconds", not_negative),
             .created = timestamp(row, "created"),
             .started = optional(row, "started", timestamp),
             .finished = optional(row, "finished", timestamp),
             .code_version = optional_text(row, "code_version"),
             .host = optional_text(row, "host"),
             .series = text(row, "series"),
             .starts_over = integer(row, "starts_over", 0, 1) == 1};
  must_be_countable(job.job, job.tau_max);
  return job;
}

Owner owner(const SQLite::Statement& row) {
  return {.host = text(row, "host"),
          .boot_id = text(row, "owner_boot_id"),
          .pid = integer(row, "owner_pid"),
          .started = integer(row, "owner_started")};
}

Progress progress_of(const SQLite::Statement& row) {
  return {.tau = not_negative(row, "tau_reached"),
          .collisions = integer(row, "collisions", 0),
          .cpu_seconds = not_negative(row, "cpu_seconds")};
}

Sample sample(const SQLite::Statement& row) {
  Sample sample{.tau = not_negative(row, "tau"), .time = not_negative(row, "time")};
  for (const SampleColumn& column : sample_columns)
    sample.*column.value = optional_real(row, column.name);
  return sample;
}

CheckpointInfo checkpoint_info(const SQLite::Statement& row) {
  return {.job_id = integer(row, "job_id"),
          .tau = not_negative(row, "tau"),
          .collisions = integer(row, "collisions", 0),
          .bytes = integer(row, "bytes", 0)};
}

SnapshotInfo snapshot_info(const SQLite::Statement& row) {
  return {.tau = not_negative(row, "tau"),
          .time = not_negative(row, "time"),
          .collisions = integer(row, "collisions", 0),
          .bytes = integer(row, "bytes", 0)};
}

Field field_of(const SQLite::Statement& row) {
  // 32 cells are the most that a job takes; this many are far more, and no size overflows.
  constexpr std::int64_t most_cells = 1024;
  const auto d = static_cast<int>(integer(row, "d", 2, 3));
  Field field{.name = text(row, "name"),
              .tau = not_negative(row, "tau"),
              .cells = static_cast<int>(integer(row, "cells", 1, most_cells)),
              .components = static_cast<int>(integer(row, "components", 1, 3)),
              .box = positive(row, "box")};
  std::size_t values = static_cast<std::size_t>(field.components);
  for (int axis = 0; axis < d; ++axis) values *= static_cast<std::size_t>(field.cells);
  const auto data = row.getColumn("data");
  if (!data.isBlob() || static_cast<std::size_t>(data.getBytes()) != values * sizeof(double))
    throw BadValue("the field " + field.name + " at tau = " + std::to_string(field.tau) +
                   " does not hold as many values as its cells and components say");
  field.values.resize(values);
  std::memcpy(field.values.data(), data.getBlob(), values * sizeof(double));
  return field;
}

std::vector<std::uint64_t> pilots(const SQLite::Statement& row) {
  return canonical(row, "pilots", seeds_in, seeds_text);
}

std::string seeds_text(const std::vector<std::uint64_t>& seeds) {
  return nlohmann::json(seeds).dump();
}

std::vector<std::uint64_t> seeds_in(const std::string& text) {
  return nlohmann::json::parse(text).get<std::vector<std::uint64_t>>();
}

}  // namespace haff::schema
