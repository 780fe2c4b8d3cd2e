// SPDX-License-Identifier: GPL-3.0-or-later

#include "fuzz/edits.hpp"

#include <SQLiteCpp/SQLiteCpp.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <fstream>
#include <iterator>
#include <vector>

#include "campaign/state/checkpoint.hpp"
#include "engine/initial.hpp"
#include "engine/simulation.hpp"
#include "schema/digests/checksum.hpp"
#include "schema/store/store.hpp"

namespace haff::tests {

namespace {

using namespace schema;

// ---- the store --------------------------------------------------------------------------------

constexpr std::uint32_t particles = 12;
constexpr double tau_max = 5;

std::vector<Planned> jobs() {
  Job plain{.kind = Kind::cooling,
            .e = 0.8,
            .n = 0.1,
            .particles = particles,
            .seed = 1,
            .observables = {"correlations", "fields", "laguerre", "temperature"},
            .profiles_every = 5,
            .fields_at = {5}};
  Job disks{.kind = Kind::cooling, .d = 2, .e = 0.9, .n = 0.1, .particles = particles, .seed = 2};
  Job heated = plain;
  heated.effects = R"({"thermostat":{"rate":0.05}})";
  std::vector<Planned> all;
  for (const Job& job : {plain, disks, heated}) {
    const Job start = equilibration_of(job);
    if (std::ranges::none_of(all, [&](const Planned& each) { return each.job == start; }))
      all.push_back({.job = start, .tau_max = start.equilibrate});
    all.push_back({.job = job, .tau_max = tau_max, .expected_cpu_seconds = 1});
  }
  return all;
}

Checkpoint checkpoint(const Job& job) {
  engine::State state = engine::initial_state(job.n, job.particles, job.seed, job.d);
  state.collisions = engine::collisions_at(tau_max, job.particles);
  state.time = 1;
  return {.tau = tau_max, .collisions = state.collisions, .state = campaign::encode(state)};
}

Commit commit(const Job& job) {
  Commit made{.checkpoint = checkpoint(job),
              .invariants = Invariants{.largest_overlap = 1e-15},
              .physics_version = engine::physics_version,
              .progress = {.tau = tau_max, .cpu_seconds = 1}};
  for (int k = 0; k <= 5; ++k)
    made.samples.push_back({.tau = 1.0 * k, .time = 0.2 * k, .temperature = 2.0 / job.d});
  made.profiles.push_back({.name = "rho", .tau = 5, .x = {0.5, 1.5}, .value = {0.1, 0.2}});
  made.fields.push_back({.name = "density",
                         .tau = 5,
                         .cells = 2,
                         .components = 1,
                         .box = 5,
                         .values = std::vector<double>(job.d == 2 ? 4 : 8, 0.1)});
  return made;
}

// Finishes all jobs but the last.
void work(Store& store) {
  const Owner owner{.host = "here", .boot_id = "now", .pid = 1, .started = 1};
  while (const auto claim = store.claim(owner, "fuzz")) {
    if (claim->job.effects.contains("thermostat")) {
      store.commit(claim->lease, commit(claim->job));
      return;
    }
    const bool cools = claim->job.kind == Kind::cooling;
    store.finish(claim->lease, commit(claim->job),
                 cools ? std::optional(Results{.tau_c = 3.5, .time_c = 0.7}) : std::nullopt,
                 claim->tau_max);
  }
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// ---- edits ------------------------------------------------------------------------------------

constexpr std::array tables{
    "jobs",       "samples",     "profiles",           "fields",   "results",
    "invariants", "checkpoints", "checkpoint_chunks",  "campaign", "shards",
    "loans",      "targets",     "target_predictions", "digests",  "table_digests",
    "log"};

struct Column {
  std::string table, name;
};

// A column of a table, chosen by bytes of the input.
Column column(SQLite::Database& store, Input& input) {
  Column chosen{tables[input.byte() % tables.size()], {}};
  std::vector<std::string> names;
  SQLite::Statement info(store, "SELECT name FROM pragma_table_info(?)");
  info.bind(1, chosen.table);
  while (info.executeStep()) names.push_back(info.getColumn(0).getString());
  chosen.name = names[input.byte() % names.size()];
  return chosen;
}

void bind_some_value(SQLite::Statement& statement, Input& input) {
  static constexpr std::array<double, 8> reals{0.0, -1.0, 1e300, 5e-324, 1e12, 0x1p53, 0.5, 1e-9};
  switch (input.byte() % 7) {
    case 0:
      statement.bind(1);
      break;
    case 1:
      statement.bind(1, static_cast<std::int64_t>(input.number(8)));
      break;
    case 2:
      statement.bind(1, static_cast<std::int64_t>(input.number(1)));
      break;
    case 3:
      statement.bind(1, std::bit_cast<double>(input.number(8)));
      break;
    case 4:
      statement.bind(1, reals[input.byte() % reals.size()]);
      break;
    case 5:
      statement.bind(1, input.text(input.byte()));
      break;
    default: {
      const std::string bytes = input.text(input.byte());
      statement.bind(1, bytes.data(), static_cast<int>(bytes.size()));
    }
  }
}

// A value that the table refuses (STRICT column, existing key) leaves the row as it was.
void set_a_value(SQLite::Database& store, Input& input) {
  const Column chosen = column(store, input);
  const int row = input.byte() % 8;
  SQLite::Statement update(store, "UPDATE " + chosen.table + " SET " + chosen.name +
                                      " = ?1 WHERE rowid = (SELECT rowid FROM " + chosen.table +
                                      " LIMIT 1 OFFSET ?2)");
  bind_some_value(update, input);
  update.bind(2, row);
  update.exec();
}

void delete_a_row(SQLite::Database& store, Input& input) {
  const std::string table = tables[input.byte() % tables.size()];
  SQLite::Statement drop(store, "DELETE FROM " + table + " WHERE rowid = (SELECT rowid FROM " +
                                    table + " LIMIT 1 OFFSET ?)");
  drop.bind(1, input.byte() % 8);
  drop.exec();
}

// Changes bytes of a state and corrects both checksums, so that the bytes behind them are read.
void edit_a_state(SQLite::Database& store, Input& input) {
  SQLite::Statement row(store,
                        "SELECT job_id, bytes FROM checkpoint_chunks ORDER BY job_id LIMIT 1 "
                        "OFFSET ?");
  row.bind(1, input.byte() % 4);
  if (!row.executeStep()) return;
  const std::int64_t job_id = row.getColumn(0).getInt64();
  const std::string old = row.getColumn(1).getString();
  std::vector<std::byte> state(old.size());
  std::memcpy(state.data(), old.data(), old.size());
  row.reset();
  if (state.size() < 16) return;
  const std::size_t at = input.number(2) % state.size();
  const std::string bytes = input.text(1 + input.byte() % 16);
  for (std::size_t k = 0; k < bytes.size() && at + k < state.size(); ++k)
    state[at + k] = static_cast<std::byte>(bytes[k]);
  const std::size_t end = state.size() - sizeof(std::uint64_t);
  const std::uint64_t own = campaign::checkpoint_checksum(std::span(state).first(end));
  std::memcpy(state.data() + end, &own, sizeof own);
  SQLite::Statement chunk(store, "UPDATE checkpoint_chunks SET bytes = ? WHERE job_id = ?");
  chunk.bind(1, state.data(), static_cast<int>(state.size()));
  chunk.bind(2, job_id);
  chunk.exec();
  SQLite::Statement sum(store, "UPDATE checkpoints SET checksum = ? WHERE job_id = ?");
  sum.bind(1, static_cast<std::int64_t>(schema::checksum(state)));
  sum.bind(2, job_id);
  sum.exec();
}

// Deletes the digests, as if a program without digests had written the store.
void forget_digests(SQLite::Database& store) {
  store.exec(
      "DELETE FROM table_digests; DELETE FROM digests; "
      "INSERT INTO digests (job_id) SELECT job_id FROM jobs");
}

void edit_rows(const std::filesystem::path& file, Input& input) {
  SQLite::Database store(file.string(), SQLite::OPEN_READWRITE);
  store.exec("PRAGMA synchronous = OFF; PRAGMA journal_mode = MEMORY");
  store.exec("PRAGMA ignore_check_constraints = ON");
  for (int edits = input.byte() % 8; edits > 0; --edits) try {
      switch (input.byte() % 4) {
        case 0:
          delete_a_row(store, input);
          break;
        case 1:
          edit_a_state(store, input);
          break;
        default:
          set_a_value(store, input);
      }
    } catch (const SQLite::Exception&) {
    }
  if (input.byte() % 4 != 0) forget_digests(store);
}

}  // namespace

std::string sound_store(const std::filesystem::path& folder) {
  const auto file = folder / "sound.db";
  {
    Store store = Store::create(file);
    store.add(jobs());
    work(store);
    const std::string series = store.jobs().back().series;
    const Target target{.series = series,
                        .quantity = "a2",
                        .tau_from = 1,
                        .tau_to = 2,
                        .se = 1e-3,
                        .pilots = {1, 2, 3, 4, 5}};
    store.add(std::vector{target});
    store.predict(target, {.realizations = 9, .cpu_seconds = 3});
  }
  return bytes_of(file);
}

// Edits rows first, through SQLite, and then bytes of the file.
void write_edited(const std::string& store, Input input, const std::filesystem::path& file) {
  const auto write = [&](const std::string& bytes) {
    std::ofstream(file, std::ios::binary | std::ios::trunc)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  };
  write(store);
  edit_rows(file, input);
  std::string bytes = bytes_of(file);
  for (int edits = input.byte() % 8; edits > 0; --edits) {
    const std::size_t at = input.number(3) % bytes.size();
    const std::string others = input.text(1 + input.byte() % 8);
    bytes.replace(at, std::min(others.size(), bytes.size() - at), others);
  }
  if (input.byte() % 8 == 1) bytes.resize(input.number(3) % bytes.size() + 1);
  write(bytes);
}

}  // namespace haff::tests
