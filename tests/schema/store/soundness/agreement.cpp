// SPDX-License-Identifier: GPL-3.0-or-later

// Samples that are computed twice: by one job, or by two jobs with the same physics.
#include "schema/store/soundness/agreement.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "schema/fixture.hpp"
#include "schema/rows/sample_columns.hpp"

using namespace haff::schema;

namespace {

Sample full_sample(double tau) {
  Sample sample{.tau = tau, .time = 2 * tau};
  for (const SampleColumn& column : sample_columns) sample.*column.value = 0.5;
  return sample;
}

// A store with two cooling jobs of one gas, which sample it at other tau; the first is done.
struct TwoJobs {
  explicit TwoJobs(double sample_every = 2) {
    Job first = cooling(), second = cooling();
    second.sample_every = sample_every;
    if (sample_every == first.sample_every) second.observables = {"temperature"};
    store.add(plan({first, second}));
    equilibrate(store);
    const Claim claim = store.claim(me, "test").value();
    complete(store, claim, {full_sample(0), full_sample(1), full_sample(2)});
    done_id = claim.lease.job_id;
    held = store.claim(me, "test").value();
  }

  Store store = Store::in_memory();
  std::int64_t done_id = 0;
  Claim held;
};

}  // namespace

TEST_CASE("agreement: samples that are already stored are kept, and every column must agree") {
  TwoJobs jobs;
  const Lease lease = jobs.held.lease;
  jobs.store.commit(lease, {.samples = {full_sample(2)}});
  for (const SampleColumn& column : sample_columns) {
    CAPTURE(column.name);
    Sample again = full_sample(2);
    again.*column.value = 0.5 + 1e-3;
    CHECK_THROWS_WITH_AS(jobs.store.commit(lease, {.samples = {full_sample(4), again}}),
                         doctest::Contains(column.name), Damage);
    CHECK(jobs.store.samples(lease.job_id) == std::vector{full_sample(2)});
  }
  Sample late = full_sample(2);
  late.time = std::nextafter(late.time, 5);
  CHECK_THROWS_AS(jobs.store.commit(lease, {.samples = {late}}), Damage);
}

TEST_CASE("agreement: only the last digits of a logarithm or a transform may differ") {
  TwoJobs jobs;
  const Lease lease = jobs.held.lease;
  jobs.store.commit(lease, {.samples = {full_sample(2)}});
  for (const auto column : {&Sample::gamma_ratio, &Sample::correlation_trace}) {
    Sample again = full_sample(2);
    again.*column = std::nextafter(0.5, 1.0);
    jobs.store.commit(lease, {.samples = {again}});
    CHECK(jobs.store.samples(lease.job_id) == std::vector{full_sample(2)});
  }
  for (const auto column : {&Sample::temperature, &Sample::pressure, &Sample::a2, &Sample::a6}) {
    Sample again = full_sample(2);
    again.*column = std::nextafter(0.5, 1.0);
    CHECK_THROWS_AS(jobs.store.commit(lease, {.samples = {again}}), Damage);
  }
}

TEST_CASE("agreement: a column that only one of two samples has is not compared") {
  TwoJobs jobs;
  const Lease lease = jobs.held.lease;
  Sample less = full_sample(2);
  less.a2 = std::nullopt;
  jobs.store.commit(lease, {.samples = {less}});
  jobs.store.commit(lease, {.samples = {full_sample(2)}});
  CHECK(jobs.store.samples(lease.job_id) == std::vector{less});
}

TEST_CASE("agreement: a second job on the same gas must find the same values") {
  for (const double sample_every : {1.0, 2.0}) {
    CAPTURE(sample_every);
    TwoJobs jobs(sample_every);
    Sample other = full_sample(2);
    other.a3 = 0.5 + 1e-12;
    CHECK_THROWS_WITH_AS(complete(jobs.store, jobs.held, {full_sample(0), other}),
                         doctest::Contains("which has the same physics"), Damage);
    CHECK(jobs.store.job(jobs.held.lease.job_id).status == Status::running);
    CHECK(complete(jobs.store, jobs.held, {full_sample(0), full_sample(2)}) == Status::done);
  }
}

TEST_CASE("agreement: means over intervals are compared where the intervals are the same") {
  Sample other = full_sample(2);
  other.pressure = 0.6;
  TwoJobs same(1), different(2);
  CHECK_THROWS_AS(complete(same.store, same.held, {full_sample(0), other}), Damage);
  CHECK(complete(different.store, different.held, {full_sample(0), other}) == Status::done);
}

TEST_CASE("agreement: another seed, restitution or law is another gas") {
  Store store = Store::in_memory();
  Job other_law = cooling();
  other_law.effects = R"({"restitution":{"law":"threshold","speed":0.1}})";
  store.add(plan({cooling(), cooling(0.8, 2), cooling(0.9), other_law}));
  equilibrate(store);
  double value = 0.1;
  while (const auto claim = store.claim(me, "test")) {
    Sample sample = full_sample(1);
    sample.temperature = value += 0.1;
    CHECK(complete(store, *claim, {sample}) == Status::done);
  }
}
