// SPDX-License-Identifier: GPL-3.0-or-later

#include "crash/little_campaign.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <sys/wait.h>

#include <atomic>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace haff::tests {

std::string grid(double tau_max, int seeds) {
  return fmt::format(R"({{
  "n": 0.2, "N": 108, "tau_max": {}, "equilibrate": 10, "seeds": {}, "grids": [
  {{"e": 0.8, "profiles_every": 10, "fields_at": [20],
    "sample_at": {{"tau": [0.5], "time": [2, 9]}}, "snapshots_at": {{"tau": [5, 15], "time": [3]}},
    "observables": ["temperature", "laguerre",
    "distribution", "tail", "correlations", "structure", "pair_distribution", "energy_spectrum",
    "clusters", "cluster_sizes", "collision_statistics", "msd", "vacf@10", "fields"]}},
  {{"e": 0.9, "effects": [
    {{"roughness": {{"beta": 0.5, "q": 0.4}}}},
    {{"mixture": {{"fraction": 0.5, "diameter_ratio": 0.8, "mass_ratio": 0.1}}}},
    {{"thermostat": {{"rate": 0.05}}}},
    {{"shuffle": {{"every": 2}}}},
    {{"restitution": {{"law": "threshold", "speed": 0.1}}}}]}},
  {{"effects": {{"restitution": {{"law": "viscoelastic", "A": 0.1}}}}}},
  {{"e": 0.9, "d": 2, "start": ["crystal", "shear wave"]}}]}})",
                     tau_max, seeds);
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

Result run_program(const std::filesystem::path& folder, const std::string& words,
                   const std::string& environment) {
  static std::atomic<int> number = 0;
  const std::string said = fmt::format("said-by-{}", ++number);
  const std::string command = fmt::format("cd '{}' && {} timeout -k 1 60 '{}' {} > {} 2>&1",
                                          folder.string(), environment, program, words, said);
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), text_of(folder / said)};
}

Result shell(const std::filesystem::path& folder, const std::string& words,
             const std::string& environment) {
  return run_program(folder, fmt::format("--store {} {}", store_name, words), environment);
}

std::string rows(const std::filesystem::path& folder) {
  const SQLite::Database store((folder / store_name).string(), SQLite::OPEN_READONLY, 10'000);
  std::string all;
  for (const char* sql :
       {"SELECT identity, status, quote(samples.tau), quote(time), quote(temperature), "
        "quote(gamma_ratio), quote(collision_rate), quote(pressure), quote(a2), quote(a6), "
        "quote(rotational_temperature) FROM samples JOIN jobs USING (job_id) ORDER BY 1, "
        "samples.tau",
        "SELECT identity, name, quote(profiles.tau), quote(x), quote(value) FROM profiles JOIN "
        "jobs USING (job_id) ORDER BY identity, name, profiles.tau, x",
        "SELECT identity, name, quote(fields.tau), hex(data) FROM fields JOIN jobs USING (job_id) "
        "ORDER BY identity, name, fields.tau",
        "SELECT identity, quote(time), quote(snapshots.tau), checksum, hex(snapshot_chunks.bytes) "
        "FROM snapshots JOIN snapshot_chunks USING (job_id, time) JOIN jobs USING (job_id) "
        "ORDER BY identity, time, position",
        "SELECT identity, quote(tau_c), quote(time_c) FROM results JOIN jobs USING (job_id) ORDER "
        "BY identity"}) {
    SQLite::Statement row(store, sql);
    while (row.executeStep()) {
      for (int k = 0; k < row.getColumnCount(); ++k) all += row.getColumn(k).getString() + ' ';
      all += '\n';
    }
  }
  return all;
}

bool contains(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

void must_succeed(const Result& result) {
  if (result.exit_code != 0) throw std::runtime_error("the campaign itself fails: " + result.said);
}

std::optional<std::string> complete(const std::filesystem::path& folder, bool may_lack_jobs,
                                    const std::string& expected) {
  if (may_lack_jobs)
    if (const Result plan = shell(folder, "plan grid.json"); plan.exit_code != 0)
      return "the next plan fails: " + plan.said;
  Result run = shell(folder, "run --workers 1");
  if (run.exit_code == 1 && contains(run.said, "retry")) {
    shell(folder, "retry");
    run = shell(folder, "run --workers 1");
  }
  if (run.exit_code != 0) return "the next run fails: " + run.said;
  if (rows(folder) != expected) return "the rows differ in the end";
  if (const Result end = shell(folder, "verify"); end.exit_code != 0)
    return "in the end: " + end.said;
  return std::nullopt;
}

}  // namespace haff::tests
