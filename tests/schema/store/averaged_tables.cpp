// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/store/averaged_tables.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <doctest/doctest.h>

#include <fstream>
#include <string>

#include "schema/fixture.hpp"
#include "support/temporary_folder.hpp"

using namespace haff;
using namespace haff::schema;

namespace {

// A gas with two realizations, each with one sample beside the first one.
Store two_realizations() {
  auto store = Store::in_memory();
  store.add(plan({cooling(0.8, 1), cooling(0.8, 2)}));
  equilibrate(store);
  for (const double temperature : {0.5, 0.25}) {
    const auto claim = store.claim(me, "test");
    REQUIRE(claim);
    store.finish(claim->lease,
                 {.samples = {{.tau = 0, .temperature = 2.0 / 3},
                              {.tau = 1, .time = 0.1, .temperature = temperature}},
                  .checkpoint = Checkpoint{.tau = claim->tau_max, .state = bytes(8)},
                  .progress = {.tau = claim->tau_max}},
                 std::nullopt, claim->tau_max);
  }
  return store;
}

std::vector<std::string> rows(SQLite::Database& file, const std::string& sql) {
  SQLite::Statement statement(file, sql);
  std::vector<std::string> all;
  while (statement.executeStep()) {
    std::string row;
    for (int k = 0; k < statement.getColumnCount(); ++k)
      row += statement.getColumn(k).getString() + "|";
    all.push_back(row);
  }
  return all;
}

}  // namespace

TEST_CASE("averaged tables: a computed table is added") {
  const Store store = two_realizations();
  const auto content = averaged_tables(
      store, {{"theory", {"name", "x", "value"}, {{Value("a2"), Value(0.5), Value(Null{})}}}});
  const TemporaryFolder folder;
  const auto path = folder / "averages.db";
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(content.data()),
             static_cast<std::streamsize>(content.size()));
  SQLite::Database file(path.string(), SQLite::OPEN_READONLY);
  CHECK(rows(file, "SELECT name, x, value IS NULL FROM theory") ==
        std::vector<std::string>{"a2|0.5|1|"});
}

TEST_CASE("averaged tables: the file is one that SQLite reads, with the rows of the views") {
  const Store store = two_realizations();
  const std::vector<std::byte> content = averaged_tables(store);
  const TemporaryFolder folder;
  const auto path = folder / "averages.db";
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(content.data()),
             static_cast<std::streamsize>(content.size()));
  SQLite::Database file(path.string(), SQLite::OPEN_READONLY);
  CHECK(rows(file, "PRAGMA integrity_check") == std::vector<std::string>{"ok|"});
  CHECK(rows(file, "SELECT tau, temperature, realizations FROM mean_series WHERE tau = 1") ==
        std::vector<std::string>{"1.0|0.375|2|"});
  CHECK(rows(file, "SELECT count(*) FROM mean_series") == std::vector<std::string>{"2|"});
  CHECK(rows(file, "SELECT count(*) FROM jobs WHERE status = 'done'") ==
        std::vector<std::string>{"4|"});
  for (const char* empty : {"mean_temperatures", "mean_profiles", "target_outcomes", "job_effects"})
    CHECK(rows(file, std::string("SELECT * FROM ") + empty).empty());
}
