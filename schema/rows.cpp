#include "schema/rows.hpp"

#include <nlohmann/json.hpp>

namespace haff::schema {

Job job_of(const SQLite::Statement& row) {
  return {.kind = kind_named(text(row, "kind")),
          .d = static_cast<int>(integer(row, "d")),
          .e = optional_real(row, "e"),
          .n = real(row, "n"),
          .particles = static_cast<std::uint32_t>(integer(row, "particles")),
          .seed = static_cast<std::uint64_t>(integer(row, "seed")),
          .equilibrate = real(row, "equilibrate"),
          .sample_every = real(row, "sample_every"),
          .effects = text(row, "effects"),
          .observables = observables_in(text(row, "observables")),
          .profiles_every = optional_real(row, "profiles_every"),
          .fields_at = row.isColumnNull("fields_at") ? std::vector<double>()
                                                     : fields_at_in(text(row, "fields_at"))};
}

JobRow job_row(const SQLite::Statement& row) {
  JobRow job{.job_id = integer(row, "job_id"),
             .job = job_of(row),
             .tau_max = real(row, "tau_max"),
             .checkpoint_every = real(row, "checkpoint_every"),
             .equilibration_id = std::nullopt,
             .status = status_named(text(row, "status")),
             .attempts = static_cast<int>(integer(row, "attempts")),
             .error = optional_text(row, "error"),
             .progress = progress_of(row),
             .expected_cpu_seconds = optional_real(row, "expected_cpu_seconds"),
             .created = text(row, "created"),
             .started = optional_text(row, "started"),
             .finished = optional_text(row, "finished"),
             .code_version = optional_text(row, "code_version"),
             .host = optional_text(row, "host")};
  if (!row.isColumnNull("equilibration_id"))
    job.equilibration_id = integer(row, "equilibration_id");
  return job;
}

Owner owner(const SQLite::Statement& row) {
  return {.host = text(row, "host"),
          .boot_id = text(row, "owner_boot_id"),
          .pid = integer(row, "owner_pid"),
          .started = integer(row, "owner_started")};
}

Progress progress_of(const SQLite::Statement& row) {
  return {.tau = real(row, "tau"),
          .collisions = integer(row, "collisions"),
          .cpu_seconds = real(row, "cpu_seconds")};
}

Sample sample(const SQLite::Statement& row) {
  return {.tau = real(row, "tau"),
          .time = real(row, "time"),
          .temperature = optional_real(row, "temperature"),
          .gamma_ratio = optional_real(row, "gamma_ratio"),
          .collision_rate = optional_real(row, "collision_rate"),
          .pressure = optional_real(row, "pressure"),
          .a2 = optional_real(row, "a2"),
          .a3 = optional_real(row, "a3"),
          .a4 = optional_real(row, "a4"),
          .a5 = optional_real(row, "a5"),
          .a6 = optional_real(row, "a6"),
          .correlation_trace = optional_real(row, "correlation_trace"),
          .largest_cluster = optional_real(row, "largest_cluster"),
          .rotational_temperature = optional_real(row, "rotational_temperature"),
          .temperature_1 = optional_real(row, "temperature_1"),
          .temperature_2 = optional_real(row, "temperature_2")};
}

CheckpointInfo checkpoint_info(const SQLite::Statement& row) {
  return {.job_id = integer(row, "job_id"),
          .tau = real(row, "tau"),
          .collisions = integer(row, "collisions"),
          .bytes = integer(row, "bytes")};
}

std::string seeds_text(const std::vector<std::uint64_t>& seeds) {
  return nlohmann::json(seeds).dump();
}

std::vector<std::uint64_t> seeds_in(const std::string& text) {
  return nlohmann::json::parse(text).get<std::vector<std::uint64_t>>();
}

}  // namespace haff::schema
