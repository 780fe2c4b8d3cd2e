// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/report/explanation.hpp"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "campaign/run/process.hpp"
#include "schema/error.hpp"
#include "schema/fixture.hpp"

using namespace haff;
using namespace haff::campaign;

namespace {

// Job 1 is an equilibration from which jobs 2 and 3 start.
schema::Store planned() {
  auto store = schema::Store::in_memory();
  store.add(schema::plan({schema::cooling(0.8, 1), schema::cooling(0.9, 1)}));
  return store;
}

bool has(const std::vector<std::string>& lines, const std::string& text) {
  for (const std::string& line : lines)
    if (line.find(text) != std::string::npos) return true;
  return false;
}

std::int64_t equilibration(const schema::Reader& store) {
  for (const schema::JobRow& row : store.jobs())
    if (row.job.kind == schema::Kind::equilibration) return row.job_id;
  return 0;
}

std::int64_t any_cooling(const schema::Reader& store) {
  for (const schema::JobRow& row : store.jobs())
    if (row.job.kind == schema::Kind::cooling) return row.job_id;
  return 0;
}

}  // namespace

TEST_CASE(
    "explain: a pending equilibration waits for a run, and other jobs wait for the equilibration") {
  const schema::Store store = planned();
  const Explanation found = explain(store, equilibration(store));
  CHECK(has(found.where, "It is pending"));
  CHECK(has(found.where, "2 cooling jobs wait for it"));
  CHECK(has(found.waits_for, "no process works on this store"));
  CHECK(has(found.waits_for, "0 jobs would be taken before it"));
  CHECK(has(found.tried, "no worker has taken it"));
  CHECK(has(found.next, "begins at its start"));
}

TEST_CASE("explain: a cooling job waits for its equilibration") {
  const schema::Store store = planned();
  const Explanation found = explain(store, any_cooling(store));
  CHECK(has(found.waits_for, "Its equilibration, job"));
  CHECK(has(found.waits_for, "which is pending"));
}

TEST_CASE("explain: a running job is named with its process") {
  schema::Store store = planned();
  const schema::Owner me = this_process();
  REQUIRE(store.claim(me, "test"));
  const Explanation found = explain(store, equilibration(store));
  CHECK(has(found.where, "It is running"));
  CHECK(has(found.where, "Process " + std::to_string(me.pid) + " on " + me.host));
  CHECK(found.waits_for.empty());
}

TEST_CASE("explain: errors, the attempts that are left, and what stays stored") {
  schema::Store store = planned();
  const auto claim = store.claim(this_process(), "test");
  REQUIRE(claim);
  store.commit(claim->lease,
               {.checkpoint = schema::Checkpoint{.tau = 10, .state = schema::bytes(8)},
                .progress = {.tau = 10}});
  store.fail(claim->lease, "for a test", true);
  const Explanation again = explain(store, equilibration(store));
  CHECK(has(again.tried, "1 attempt in a row ended in an error"));
  CHECK(has(again.tried, "for a test"));
  CHECK(has(again.tried, "Its state at tau = 10 is stored"));
  CHECK(has(again.next, "goes on from tau = 10"));
  CHECK(has(again.next, "After 2 errors more"));

  const auto second = store.claim(this_process(), "test");
  REQUIRE(second);
  store.fail(second->lease, "for good", false);
  const Explanation failed = explain(store, equilibration(store));
  CHECK(has(failed.where, "It is failed"));
  CHECK(has(failed.next, "retry"));
  CHECK(has(explain(store, any_cooling(store)).next, "retry"));
}

TEST_CASE("explain: the answer as JSON; a job that does not exist is refused") {
  const schema::Store store = planned();
  const nlohmann::ordered_json object = explanation_json(explain(store, equilibration(store)));
  CHECK(object["status"] == "pending");
  CHECK(object["where"].size() == 3);
  CHECK_THROWS_AS(explain(store, 99), schema::NameError);
}
