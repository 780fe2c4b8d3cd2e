// SPDX-License-Identifier: GPL-3.0-or-later

// Samples beside their jobs, in the view series and in a user's joins.
#include <SQLiteCpp/SQLiteCpp.h>
#include <doctest/doctest.h>

#include <string>

#include "schema/digests/digests.hpp"
#include "schema/fixture.hpp"
#include "schema/sql/scripts.hpp"

using namespace haff::schema;

namespace {

Sample at(double tau, double temperature) {
  return {.tau = tau, .time = 2 * tau, .temperature = temperature, .a2 = -0.02};
}

// Two gases with one equilibration, job 1: e = 0.9 and 0.8, in an order that does not matter.
Store small_store() {
  Store store = Store::in_memory();
  store.add(plan({cooling(0.8), cooling(0.9)}));
  while (const auto claim = store.claim(me, "test"))
    complete(store, *claim, {at(0, 1), at(20, claim->job.e.value())}, Results{});
  return store;
}

std::string text_of(const Value& value) {
  if (const auto* real = std::get_if<double>(&value)) return std::to_string(*real).substr(0, 4);
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return std::to_string(*whole);
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  return "-";
}

std::string rows(const Reader& store, const std::string& sql) {
  std::string all;
  Query query = store.query(sql);
  while (const auto row = query.next())
    for (std::size_t k = 0; k < row->size(); ++k)
      all += text_of((*row)[k]) + (k + 1 < row->size() ? " " : "; ");
  return all;
}

// SQLite's own description of how it would find the rows.
std::string way_to(const Reader& store, const std::string& sql) {
  std::string all;
  Query query = store.query("EXPLAIN QUERY PLAN " + sql);
  while (const auto row = query.next()) all += text_of(row->back()) + "; ";
  return all;
}

bool contains(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

constexpr const char* by_key = "SEARCH samples USING PRIMARY KEY (job_id=? AND tau=?)";

}  // namespace

TEST_CASE("samples and jobs join by job_id alone") {
  const Store store = small_store();
  CHECK(rows(store,
             "SELECT e, temperature FROM samples JOIN jobs USING (job_id) "
             "WHERE tau = 20 AND kind = 'cooling' ORDER BY e") == "0.80 0.80; 0.90 0.90; ");
  CHECK(rows(store, "SELECT e, a2 FROM samples NATURAL JOIN jobs WHERE tau = 20 AND e = 0.9") ==
        "0.90 -0.0; ");
  CHECK(rows(store, "SELECT max(tau_reached) FROM jobs") == "90.0; ");
}

TEST_CASE("the view series has each sample beside its job's parameters") {
  const Store store = small_store();
  CHECK(rows(store, "SELECT count(*) FROM series") == rows(store, "SELECT count(*) FROM samples"));
  CHECK(rows(store,
             "SELECT e, n, particles, seed, tau, time, temperature FROM series "
             "WHERE kind = 'cooling' AND tau > 0 ORDER BY e") ==
        "0.80 0.40 1000 1 20.0 40.0 0.80; 0.90 0.40 1000 1 20.0 40.0 0.90; ");
}

TEST_CASE("conditions on samples use their key") {
  const Store store = small_store();
  CHECK(contains(way_to(store, "SELECT a2 FROM series WHERE e = 0.9 AND tau = 20"), by_key));
  CHECK(contains(way_to(store, "SELECT e, a2 FROM samples JOIN jobs USING (job_id) WHERE tau = 20"),
                 by_key));
  CHECK(contains(way_to(store, "SELECT * FROM series WHERE job_id = 2"),
                 "SEARCH jobs USING INTEGER PRIMARY KEY"));
  const std::string finished =
      way_to(store, "SELECT a2 FROM series WHERE kind = 'cooling' AND status = 'done' AND e = 0.9");
  CHECK(contains(finished, "SEARCH jobs USING INDEX jobs_averaged (e=?)"));
  CHECK(contains(finished, "SEARCH samples USING PRIMARY KEY (job_id=?)"));
}

TEST_CASE("a job has the same digest before and after its column was renamed") {
  SQLite::Database sqlite(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  const auto all = scripts();
  const auto digest = [&] {
    const DigestedTable table(sqlite, "jobs");
    SQLite::Statement row(sqlite, "SELECT " + table.columns() + " FROM jobs");
    row.executeStep();
    return table.digest(row);
  };
  const auto before = static_cast<std::size_t>(version_with("018-log.sql"));
  for (std::size_t k = 0; k < before; ++k) sqlite.exec(std::string(all[k]));
  sqlite.exec(
      "INSERT INTO jobs (identity, kind, d, e, n, particles, seed, equilibrate, sample_every, "
      "effects, observables, tau_max, checkpoint_every, tau, created) VALUES ('{}', "
      "'equilibration', 3, 1, 0.4, 1000, 1, 50, 10, '{}', '[]', 50, 10, 30, '')");
  const auto digest_before = digest();
  for (std::size_t k = before; k < all.size(); ++k) sqlite.exec(std::string(all[k]));
  CHECK(digest() == digest_before);
  CHECK(sqlite.execAndGet("SELECT tau_reached FROM jobs").getDouble() == 30);
}
