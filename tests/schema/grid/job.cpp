// SPDX-License-Identifier: GPL-3.0-or-later

// A job's identity is its physics, in one canonical text.
#include "schema/grid/job.hpp"

#include <doctest/doctest.h>

#include <stdexcept>

#include "schema/fixture.hpp"

using namespace haff::schema;

TEST_CASE("the identity is the physics as canonical JSON") {
  CHECK(identity(cooling()) ==
        R"({"d":3,"e":0.8,"effects":{},"equilibrate":50,"kind":"cooling","n":0.4,)"
        R"("observables":["laguerre","temperature"],"particles":1000,)"
        R"("sample_every":1,"seed":1})");
}

TEST_CASE("a change in any part of the physics makes another job") {
  const Job job = cooling();
  std::vector<Job> others(10, job);
  others[0].kind = Kind::equilibration;
  others[1].d = 2;
  others[2].e = 0.8000000000000002;
  others[3].n = 0.5;
  others[4].particles = 1001;
  others[5].seed = 2;
  others[6].equilibrate = 60;
  others[7].sample_every = 2;
  others[8].effects = R"({"shuffle":{"every":1}})";
  others[9].observables = {"temperature"};
  for (const Job& other : others) CHECK(identity(other) != identity(job));
}

TEST_CASE("profiles and fields are part of the physics of jobs that take them") {
  Job job = cooling();
  job.profiles_every = 10;
  job.fields_at = {20, 60.5};
  CHECK(identity(job) ==
        R"({"d":3,"e":0.8,"effects":{},"equilibrate":50,"fields_at":[20,60.5],"kind":"cooling",)"
        R"("n":0.4,"observables":["laguerre","temperature"],"particles":1000,)"
        R"("profiles_every":10,"sample_every":1,"seed":1})");
  CHECK(fields_at_in(fields_at_text(job.fields_at)) == job.fields_at);
  CHECK(identity(equilibration_of(job)) == identity(equilibration_of(cooling())));
}

TEST_CASE("the order of observables and the sign of zero are not part of the physics") {
  Job one = cooling(0.0), other = cooling(-0.0);
  one.observables = {"temperature", "laguerre"};
  other.observables = {"laguerre", "temperature"};
  CHECK(identity(one) == identity(other));
}

TEST_CASE("jobs that differ in e and sampling start from one equilibration") {
  Job one = cooling(0.8), other = cooling(0.9);
  other.sample_every = 5;
  other.observables = {"temperature"};
  CHECK(identity(equilibration_of(one)) == identity(equilibration_of(other)));
  CHECK(equilibration_of(one).e == 1);
  other.seed = 2;
  CHECK(identity(equilibration_of(one)) != identity(equilibration_of(other)));
}

TEST_CASE("names of kinds and statuses read back") {
  for (const Kind kind : {Kind::equilibration, Kind::cooling})
    CHECK(kind_named(name(kind)) == kind);
  for (const StatusEntry& entry : statuses) CHECK(status_named(name(entry.status)) == entry.status);
  CHECK_THROWS_AS(kind_named("heating"), std::invalid_argument);
  CHECK_THROWS_AS(status_named("lost"), std::invalid_argument);
}

TEST_CASE("moments of samples and snapshots are part of a job where it has them") {
  Job job = cooling();
  const std::string without = identity(job);
  job.sample_at = {.tau = {.listed = {0.5, 2}}, .time = {}};
  job.snapshots_at = {.tau = {}, .time = {.per_decade = 3, .from = 0.1}};
  const std::string with = identity(job);
  CHECK(with.find(R"("sample_at":{"tau":[0.5,2]},"sample_every":1,"seed":1,"snapshots_at":)"
                  R"({"time":{"from":0.1,"log":3}}})") != std::string::npos);
  CHECK(identity(equilibration_of(job)) == identity(equilibration_of(cooling())));
  CHECK(identity(unsampled(job)) == identity(unsampled(cooling())));
  job.sample_at = {};
  job.snapshots_at = {};
  CHECK(identity(job) == without);
}

TEST_CASE("samples at equal intervals are told from others") {
  Job job = cooling();
  job.sample_every = 0.1;
  CHECK(is_at_interval(job, 0.35));  // the job has no other samples
  job.sample_at.tau.listed = {0.35};
  CHECK(is_at_interval(job, 3 * 0.1));
  CHECK(is_at_interval(job, 0));
  CHECK_FALSE(is_at_interval(job, 0.35));
}
