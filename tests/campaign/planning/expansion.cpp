// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/planning/expansion.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

using namespace haff;
using namespace haff::campaign;

namespace {

std::vector<schema::Planned> jobs_of(const char* text) {
  return expand(schema::parse_grid(text, "grid.json", {.bytes = 1e9, .bytes_per_particle = 200}));
}

std::vector<schema::Planned> only(schema::Kind kind, std::vector<schema::Planned> jobs) {
  std::erase_if(jobs, [&](const schema::Planned& planned) { return planned.job.kind != kind; });
  return jobs;
}

std::set<std::string> identities(const std::vector<schema::Planned>& jobs) {
  std::set<std::string> all;
  for (const schema::Planned& planned : jobs) all.insert(identity(planned.job));
  return all;
}

constexpr auto cooling = schema::Kind::cooling;
constexpr auto equilibration = schema::Kind::equilibration;

}  // namespace

TEST_CASE("expansion: the product of all lists") {
  const auto jobs = jobs_of(R"({"e": [0.8, 0.9], "n": [0.2, 0.4], "N": [500, 1000], "seeds": 3,
                                "tau_max": 20, "sample_every": [1, 2]})");
  CHECK(only(cooling, jobs).size() == 2 * 2 * 2 * 3 * 2);
}

TEST_CASE("expansion: one equilibration for all e and sample_every") {
  const auto jobs = jobs_of(R"({"e": [0.8, 0.9, 1], "n": [0.2, 0.4], "N": 500, "seeds": 3,
                                "tau_max": 20, "sample_every": [1, 2]})");
  CHECK(only(equilibration, jobs).size() == 2 * 3);
  CHECK(only(equilibration, jobs).front().tau_max == 50);
}

TEST_CASE("expansion: every cooling job's equilibration is there") {
  const auto jobs = jobs_of(R"({"e": [0.8, 0.9], "n": [0.2, 0.4], "N": 500, "seeds": 3,
                                "tau_max": 20, "equilibrate": [50, 60]})");
  const auto known = identities(jobs);
  for (const schema::Planned& planned : only(cooling, jobs))
    CHECK(known.contains(identity(equilibration_of(planned.job))));
}

TEST_CASE("expansion: no job is made twice") {
  const auto jobs = jobs_of(R"({"e": 0.8, "n": 0.4, "N": 500,
      "grids": [{"seeds": 3, "tau_max": 20}, {"seeds": 5, "tau_max": 20}]})");
  CHECK(identities(jobs).size() == jobs.size());
  CHECK(only(cooling, jobs).size() == 5);
}

TEST_CASE("expansion: a job named twice gets the larger tau_max and the closer checkpoints") {
  const auto jobs = only(cooling, jobs_of(R"({"e": 0.8, "n": 0.4, "N": 500, "seeds": 1, "grids": [
      {"tau_max": 30, "checkpoint_every": 40}, {"tau_max": 20, "checkpoint_every": 10}]})"));
  REQUIRE(jobs.size() == 1);
  CHECK(jobs.front().tau_max == 30);
  CHECK(jobs.front().checkpoint_every == 10);
}

TEST_CASE("expansion: each e has its tau_max") {
  for (const schema::Planned& planned :
       only(cooling, jobs_of(R"({"e": [0.8, 0.9], "n": 0.4, "N": 500, "seeds": 2,
                                 "tau_max": {"0.80": 90, "0.9": 180}})")))
    CHECK(planned.tau_max == (planned.job.e == 0.8 ? 90 : 180));
}

TEST_CASE("expansion: keys that are not physics do not change a job") {
  const auto few = jobs_of(R"({"e": 0.8, "n": 0.4, "N": 500, "seeds": 1, "tau_max": 20})");
  const auto more = jobs_of(R"({"name": "other", "e": 0.8, "n": 0.4, "N": 500, "seeds": [1],
                                "tau_max": 90, "checkpoint_every": 20})");
  CHECK(identities(few) == identities(more));
}

TEST_CASE("expansion: spheres and disks, each with equilibrations of its own") {
  const auto jobs =
      jobs_of(R"({"d": [2, 3], "e": [0.8, 0.9], "n": 0.4, "N": 500, "seeds": 2, "tau_max": 20})");
  CHECK(only(cooling, jobs).size() == 2 * 2 * 2);
  CHECK(only(equilibration, jobs).size() == 2 * 2);
  CHECK(identities(jobs).size() == jobs.size());
}
