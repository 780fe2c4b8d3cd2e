// SPDX-License-Identifier: GPL-3.0-or-later

// The jobs that a user's SQL chooses, the order in which they are claimed, and SQL that is refused.
#include "schema/store/planning/choice.hpp"

#include <doctest/doctest.h>

#include <string>

#include "schema/fixture.hpp"

using namespace haff::schema;

namespace {

// Two e and two seeds: equilibrations 1 and 4, cooling jobs 2, 3 (seed 1) and 5, 6 (seed 2).
Store small_store() {
  Store store = Store::in_memory();
  Job rough = cooling(0.9, 2);
  rough.effects = R"({"roughness":{"beta":0.5,"q":0.4}})";
  rough.particles = 2000;
  store.add(plan({cooling(0.8, 1), cooling(0.9, 1), cooling(0.8, 2), rough}));
  return store;
}

std::size_t chosen(const Store& store, const std::string& where) {
  return chosen_jobs(store, Choice(store, where)).size();
}

std::string complaint(const std::string& where, const std::string& order = {}) {
  const Store store = small_store();
  try {
    const Choice choice(store, where, order);
  } catch (const QueryError& error) {
    return error.what();
  }
  return "not refused";
}

Selection selection(const std::string& where, const std::string& order = {}) {
  Store store = small_store();
  const Choice choice(store, where, order);
  return {std::move(store), choice};
}

// Runs all chosen jobs, one after another: "equilibration 1, cooling 0.8 1, ...".
std::string order_of_work(Selection& store) {
  std::string text;
  while (const auto claim = store.claim(me, "test")) {
    const Job& job = claim->job;
    text += (text.empty() ? "" : ", ") + std::string(name(job.kind)) + " ";
    if (job.kind == Kind::cooling) text += std::to_string(*job.e).substr(0, 3) + " ";
    text += std::to_string(job.seed);
    complete(store, *claim);
  }
  return text;
}

}  // namespace

TEST_CASE("a condition chooses cooling jobs by their columns, by N and by parameters of effects") {
  const Store store = small_store();
  CHECK(chosen(store, "e = 0.8") == 2);
  CHECK(chosen(store, "e > 0.5") == 4);  // but no equilibration, although its e is 1
  CHECK(chosen(store, "N = 2000") == 1);
  CHECK(chosen(store, "n = 0.4") == 4);
  CHECK(chosen(store, "roughness.beta = 0.5") == 1);
  CHECK(chosen(store, "roughness.beta IS NULL AND jobs.e = 0.9") == 1);
  CHECK(chosen(store, "job_id IN (SELECT job_id FROM samples)") == 0);
  CHECK(chosen(store, "e = 0.8 -- and that is all") == 2);
}

TEST_CASE("only a condition that names kind or job_id chooses among equilibrations") {
  const Store store = small_store();
  CHECK(chosen(store, "kind = 'equilibration'") == 3);
  CHECK(chosen(store, "job_id = 1") == 1);
  CHECK(chosen(store, "seed = 1") == 2);
}

TEST_CASE("SQL that is not a condition, or that writes, is refused") {
  CHECK(complaint("e = 0.9, n = 0.4").find("is not a condition") != std::string::npos);
  CHECK(complaint("DELETE FROM jobs").find("syntax error") != std::string::npos);
  CHECK(complaint("1); DELETE FROM jobs; --").find("one statement at a time") != std::string::npos);
  CHECK(complaint("e = 0.9)").find("is not a condition") != std::string::npos);
  CHECK(complaint("count(*) > 3").find("misuse of aggregate") != std::string::npos);
  CHECK(complaint("e") ==
        "--where \"e\" is not a condition over the table jobs: it gives 0.8, neither true nor "
        "false; expected e.g. \"e = 0.9 AND N < 10000\"");
  CHECK(complaint("'e = 0.8'").find("neither true nor false") != std::string::npos);
  CHECK(complaint("sed = 3") ==
        "--where \"sed = 3\" is not a condition over the table jobs: no such column: sed; did you "
        "mean \"seed\"?");
  CHECK(complaint("roughness.bta = 0.5") ==
        "--where \"roughness.bta = 0.5\": no job of the store has a roughness.bta; did you mean "
        "\"roughness.beta\"?");
  CHECK(complaint("", "seed LIMIT 3").find("--order \"seed LIMIT 3\" is not a list of terms") == 0);
  CHECK(complaint("", "seed LIMIT 3").ends_with("; expected e.g. \"seed, N DESC\""));
  CHECK(complaint("", "sed").ends_with("no such column: sed; did you mean \"seed\"?"));
}

TEST_CASE("a selection runs the chosen jobs, and first the equilibrations from which they start") {
  Selection store = selection("e = 0.9 AND seed = 1");
  CHECK(store.summary().claimable == 1);  // the equilibration
  CHECK(store.summary().waiting == 1);
  CHECK(store.job_ids().size() == 2);
  CHECK(order_of_work(store) == "equilibration 1, cooling 0.9 1");
  CHECK_FALSE(store.has_claimable({}));
  CHECK(store.summary().jobs.at(Status::done) == 2);
  CHECK(store.Store::summary().jobs.at(Status::pending) == 5);
  CHECK(store.series().size() == 1);
}

TEST_CASE("a selection may be of equilibrations alone") {
  Selection store = selection("kind = 'equilibration' AND seed = 2");
  CHECK(order_of_work(store) == "equilibration 2, equilibration 2");
}

TEST_CASE("jobs are claimed in the given order, each after its equilibration") {
  Selection up = selection("N = 1000", "seed, e DESC");
  CHECK(order_of_work(up) ==
        "equilibration 1, cooling 0.9 1, cooling 0.8 1, equilibration 2, cooling 0.8 2");
  Selection down = selection("", "e, seed DESC");
  CHECK(order_of_work(down) ==
        "equilibration 2, cooling 0.8 2, equilibration 1, cooling 0.8 1, equilibration 2, "
        "cooling 0.9 2, cooling 0.9 1");
}

TEST_CASE("without a condition, a selection is the whole store") {
  Selection store = selection("");
  CHECK(store.choice().is_everything());
  CHECK(store.summary().jobs.at(Status::pending) == 7);
  CHECK(order_of_work(store).substr(0, 48) == "equilibration 2, equilibration 1, equilibration ");
}

TEST_CASE("a condition on seeds or job numbers excludes further realizations") {
  const Store store = small_store();
  CHECK(Choice(store, "seed < 3").names_realizations());
  CHECK(Choice(store, "e = 0.8 AND job_id < 3").names_realizations());
  CHECK_FALSE(Choice(store, "e = 0.8").names_realizations());
}
