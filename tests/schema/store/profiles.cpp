// SPDX-License-Identifier: GPL-3.0-or-later

// Profiles and fields are written with the samples beside them, never changed, read back bit for
// bit, and averaged over realizations.
#include <SQLiteCpp/SQLiteCpp.h>
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "schema/fixture.hpp"

using namespace haff::schema;

namespace {

Job job_with_profiles(std::uint64_t seed = 1) {
  Job job = cooling(0.8, seed);
  job.observables = {"distribution", "fields", "temperature"};
  job.profiles_every = 10;
  job.fields_at = {10};
  return job;
}

Field velocity() {
  Field field{.name = "velocity", .tau = 10, .cells = 2, .components = 3, .box = 13.5};
  for (int i = 0; i < 24; ++i) field.values.push_back(0.1 * i);
  field.values[4] = std::numeric_limits<double>::quiet_NaN();
  return field;
}

// A store in which these jobs are being run.
struct Working {
  Store store = Store::in_memory();
  std::vector<Claim> claims;

  explicit Working(const std::vector<Job>& jobs) {
    store.add(plan(jobs));
    equilibrate(store);
    while (const auto claim = store.claim(me, "test")) claims.push_back(*claim);
  }
};

}  // namespace

TEST_CASE("a job keeps the times of its profiles and fields") {
  const Working working({job_with_profiles()});
  CHECK(identity(working.claims.at(0).job) == identity(job_with_profiles()));
  CHECK(working.store.job(working.claims[0].lease.job_id).job.profiles_every == 10.0);
  CHECK(working.store.job(working.claims[0].lease.job_id).job.fields_at == std::vector{10.0});
}

TEST_CASE("profiles and fields come back bit for bit") {
  Working working({job_with_profiles()});
  const auto lease = working.claims.at(0).lease;
  const Profile early{"rho", 0, {0.05, 0.15, 0.25}, {0.99, 0.97, 0.1 + 0.2}};
  const Profile late{"rho", 10, {0.05, 0.15, 0.25}, {1e-300, 0, 3}};
  const Profile other{"S", 0, {0.1}, {0.03}};
  working.store.commit(lease, {.profiles = {late, early, other}, .fields = {velocity()}});
  CHECK(working.store.profiles(lease.job_id, "rho") == std::vector{early, late});
  CHECK(working.store.profiles(lease.job_id, "S") == std::vector{other});
  CHECK(working.store.profiles(lease.job_id, "G").empty());

  const auto field = working.store.field(lease.job_id, "velocity", 10);
  REQUIRE(field);
  CHECK(field->cells == 2);
  CHECK(field->components == 3);
  CHECK(field->box == 13.5);
  REQUIRE(field->values.size() == 24);
  for (std::size_t i = 0; i < 24; ++i)
    CHECK((i == 4 ? std::isnan(field->values[i]) : field->values[i] == velocity().values[i]));
  CHECK_FALSE(working.store.field(lease.job_id, "velocity", 20));
}

TEST_CASE("rows of profiles and fields never change") {
  Working working({job_with_profiles()});
  const auto lease = working.claims.at(0).lease;
  const Profile first{"rho", 0, {0.05}, {1}};
  working.store.commit(lease, {.profiles = {first}, .fields = {velocity()}});
  Field changed = velocity();
  changed.values[0] = 7;
  working.store.commit(lease, {.profiles = {{"rho", 0, {0.05}, {2}}}, .fields = {changed}});
  CHECK(working.store.profiles(lease.job_id, "rho") == std::vector{first});
  CHECK(working.store.field(lease.job_id, "velocity", 10)->values[0] == 0);
}

TEST_CASE("a profile that is not finite undoes its commit") {
  Working working({job_with_profiles()});
  const auto lease = working.claims.at(0).lease;
  const Commit commit{.samples = {{.tau = 0}},
                      .profiles = {{"rho", 0, {0.05, 0.15}, {1, std::nan("")}}}};
  CHECK_THROWS_AS(working.store.commit(lease, commit), Damage);
  CHECK(working.store.samples(lease.job_id).empty());
  CHECK(working.store.profiles(lease.job_id, "rho").empty());
}

TEST_CASE("profiles are averaged point by point over realizations") {
  Working working({job_with_profiles(1), job_with_profiles(2), job_with_profiles(3)});
  for (const Claim& claim : working.claims) {
    const auto seed = static_cast<double>(claim.job.seed);
    working.store.commit(claim.lease, {.profiles = {{"rho", 10, {0.05, 0.15}, {seed, 5}}}});
    complete(working.store, claim, {}, Results{});
  }
  Query means =
      working.store.query("SELECT name, tau, x, realizations, value, value_se FROM mean_profiles");
  CHECK(means.next() == Row{"rho", 10.0, 0.05, std::int64_t{3}, 2.0, std::sqrt(1.0 / 3)});
  CHECK(means.next() == Row{"rho", 10.0, 0.15, std::int64_t{3}, 5.0, 0.0});
  CHECK_FALSE(means.next());
}

TEST_CASE("realizations with profiles at different times are averaged together") {
  Job often = job_with_profiles(2);
  often.profiles_every = 5;
  Working working({job_with_profiles(1), often});
  for (const Claim& claim : working.claims) {
    working.store.commit(claim.lease,
                         {.samples = {{.tau = 0}}, .profiles = {{"rho", 0, {0.05}, {1}}}});
    complete(working.store, claim, {}, Results{});
  }
  for (const char* view : {"mean_series", "mean_profiles", "mean_tau_c"}) {
    Query means = working.store.query(std::string("SELECT realizations FROM ") + view);
    CHECK(means.next() == Row{std::int64_t{2}});
    CHECK_FALSE(means.next());
  }
}

TEST_CASE("a field whose data do not match its cells is damaged") {
  const TemporaryFolder folder;
  Store store = Store::create(folder / "a.db");
  store.add(plan({job_with_profiles()}));
  equilibrate(store);
  const Claim claim = *store.claim(me, "test");
  store.commit(claim.lease, {.fields = {velocity()}});
  CHECK(store.field(claim.lease.job_id, "velocity", 10).has_value());
  CHECK(store.fields(claim.lease.job_id).size() == 1);
  SQLite::Database vandal((folder / "a.db").string(), SQLite::OPEN_READWRITE);
  vandal.exec("UPDATE digests SET fields = NULL");  // the digests would notice any change
  for (const char* change : {"cells = 1", "cells = 68", "cells = 4611686018427387904",
                             "components = 1", "data = x'0000000000000000'", "box = -1"}) {
    CAPTURE(change);
    vandal.exec("SAVEPOINT before");
    vandal.exec(std::string("UPDATE fields SET ") + change);
    vandal.exec("RELEASE before");
    CHECK_THROWS_AS(store.field(claim.lease.job_id, "velocity", 10), Damage);
    vandal.exec("DELETE FROM fields");
    store.commit(claim.lease, {.fields = {velocity()}});
  }
}
