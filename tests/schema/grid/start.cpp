// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/grid/start.hpp"

#include <doctest/doctest.h>

#include <stdexcept>
#include <string>

#include "schema/fixture.hpp"
#include "schema/grid/complaint.hpp"

using namespace haff::schema;

namespace {

std::vector<AskedStart> starts(const std::string& value) {
  return parse(with("start", value)).grids[0].starts;
}

}  // namespace

TEST_CASE("start: a name, a name with parameters, or a list") {
  CHECK(parse(with("seeds", "1")).grids[0].starts.size() == 1);
  CHECK(starts(R"("uniform")")[0].start.is_uniform());
  CHECK(starts(R"("crystal")")[0].start == Start{.kind = Start::Kind::crystal});
  CHECK(starts(R"("shear wave")")[0].start ==
        Start{.kind = Start::Kind::shear_wave, .amplitude = 0.5, .waves = 1});
  CHECK(starts(R"({"shear wave": {"waves": 3}})")[0].start ==
        Start{.kind = Start::Kind::shear_wave, .amplitude = 0.5, .waves = 3});
  CHECK(starts(R"({"two temperatures": {"ratio": 0.5}})")[0].start ==
        Start{.kind = Start::Kind::two_temperatures, .ratio = 0.5});
  const auto file = starts(R"(["crystal", {"file": "gas.xyz"}])")[1];
  CHECK(file.start.kind == Start::Kind::file);
  CHECK(file.file == "gas.xyz");
  CHECK(file.place == "g.json: /start/1/file");
}

TEST_CASE("start: the text of a start is read back") {
  for (const char* text : {R"("crystal")", R"({"shear wave":{"amplitude":0.25,"waves":2}})",
                           R"({"two temperatures":{"ratio":4}})", R"({"file":"0123456789abcdef"})"})
    CHECK(start_text(start_in(text)) == text);
  for (const char* text :
       {R"("uniform")", R"("x")", "3", "{}", R"({"shear wave":{}})", R"({"file":"x"})",
        R"({"two temperatures":{"ratio":-1}})", R"({"shear wave":{"amplitude":2,"waves":1}})"})
    CHECK_THROWS_AS(start_in(text), std::exception);
}

TEST_CASE("start: it is part of a job's identity, and of its equilibration's if nothing is run") {
  Job job = cooling();
  const std::string uniform = identity(job);
  job.start = {.kind = Start::Kind::shear_wave, .amplitude = 0.5, .waves = 1};
  CHECK(identity(job) != uniform);
  CHECK(identity(equilibration_of(job)) == identity(equilibration_of(cooling())));
  CHECK_FALSE(cools_by_haff(job));
  job.start = {.kind = Start::Kind::crystal};
  job.equilibrate = 0;
  CHECK(identity(equilibration_of(job)).find(R"("start":"crystal")") != std::string::npos);
  CHECK(equilibration_of(job).seed == job.seed);
  CHECK(tau_max_of_equilibration(equilibration_of(job)) > 0);
  job.start = {.kind = Start::Kind::file, .digest = "0123456789abcdef"};
  CHECK(equilibration_of(job).seed == 0);  // one state for all seeds

  Store store = Store::in_memory();
  store.add(plan({job}));
  CHECK(store.job(store.find(job).value()).job == store.job(store.find(job).value()).job);
  CHECK(store.job(store.find(job).value()).job.start == job.start);
}

TEST_CASE("start: a given state counts as an equilibration, and is put back by another plan") {
  Job job = cooling();
  job.start = {.kind = Start::Kind::file, .digest = "0123456789abcdef"};
  job.equilibrate = 0;
  auto given = plan({job});
  given[0].given_state = std::make_shared<Checkpoint>(Checkpoint{.state = bytes(100)});
  Store store = Store::in_memory();
  store.add(given);
  const std::int64_t start = store.find(given[0].job).value();
  CHECK(store.job(start).status == Status::done);
  CHECK(store.checkpoint(start)->state == bytes(100));
  CHECK(store.digests(start).wrong.empty());
  const auto claim = store.claim(me, "test");
  REQUIRE(claim.has_value());
  CHECK(claim->equilibration_id == start);
  store.release(claim->lease);
  store.restart(start);
  CHECK(store.add(given)[0] == Outcome::unchanged);
  CHECK(store.job(start).status == Status::done);
  CHECK_FALSE(store.job(start).starts_over);
}

TEST_CASE("start: bad input is refused") {
  check_complaint(with("start", R"("sheer wave")"),
                  "g.json: /start: \"sheer wave\" is not accepted; did you mean \"shear wave\"?");
  check_complaint(
      with("start", R"({"shear wave": {"amplitude": 2}})"),
      "g.json: /start/shear wave/amplitude: 2 is not accepted; expected an amplitude "
      "above 0 and at most 1.9 [sqrt(E(0)/m)]: at 2, the flow would be all of the energy");
  check_complaint(with("start", R"({"two temperatures": {"ration": 2}})"),
                  "g.json: /start/two temperatures/ration: unknown key; did you mean \"ratio\"?");
  check_complaint(
      with("start", R"("crystal", "equilibrate": 100)"),
      "g.json: /equilibrate: 100 does not go together with \"start\": \"crystal\", which is not "
      "equilibrated; expected a grid without it");
  CHECK(complaint(with("start", R"(["crystal", "uniform"], "equilibrate": 100)")) ==
        "no complaint");
  check_complaint(R"({"e": 0.8, "n": 0.4, "N": 1000, "seeds": 2, "tau_max": 9,
                      "start": {"file": "a.xyz"}})",
                  "g.json: /seeds: 2 makes realizations that are all the same: they start from "
                  "{\"file\":\"a.xyz\"}, and nothing in them is random; expected one seed");
}
