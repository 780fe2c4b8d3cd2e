// SPDX-License-Identifier: GPL-3.0-or-later

// Inelastic collapse, as a user of the program sees it.
#include <doctest/doctest.h>

#include <string>

#include "cli/program.hpp"

using namespace haff::tests;

namespace {

// This gas collapses within a few collisions per particle (four spheres in a line, e below 0.17).
std::string grid(const std::string& effects) {
  return R"({"e": 0.1, "n": 0.4, "N": 1000, "seeds": 1, "tau_max": 50, "sample_every": 0.5, "effects": )" +
         effects + "}";
}

}  // namespace

TEST_CASE("collapse: it ends a job, which keeps its series and does not count as failed") {
  const Folder folder;
  folder.write("grid.json", grid("{}"));
  REQUIRE(campaign(folder, {"plan", "grid.json"}).exit_code == 0);
  CHECK(campaign(folder, {"run"}).exit_code == 0);
  CHECK(number(folder, "SELECT count(*) FROM jobs WHERE status = 'collapsed'") == 1);
  CHECK(number(folder,
               "SELECT count(*) FROM jobs WHERE error LIKE 'inelastic collapse of particles % at "
               "tau = %'") == 1);
  CHECK(number(folder, "SELECT tau_reached FROM jobs WHERE status = 'collapsed'") > 0);
  // The series ends at the collapse.
  CHECK(
      number(folder,
             "SELECT count(*) = floor(tau_reached / 0.5) + 1 FROM samples JOIN jobs USING (job_id) "
             "WHERE status = 'collapsed'") == 1);
  CHECK(number(folder, "SELECT count(*) FROM results") == 0);
  CHECK(number(folder,
               "SELECT unresolved_collisions FROM invariants JOIN jobs USING (job_id) "
               "WHERE status = 'collapsed'") == 3);
  const Outcome status = campaign(folder, {"status"});
  CHECK(status.out.find("collapsed: inelastic collapse of particles") != std::string::npos);
  CHECK(status.out.find("unresolved collisions") != std::string::npos);
  CHECK(campaign(folder, {"verify"}).exit_code == 0);
  // The job is neither done nor failed: it is neither retried nor run.
  campaign(folder, {"retry"});
  CHECK(campaign(folder, {"run"}).exit_code == 0);
  CHECK(number(folder, "SELECT count(*) FROM jobs WHERE status = 'collapsed'") == 1);
}

TEST_CASE("collapse: a gas with a duration of contact or a threshold goes on") {
  const Folder folder;
  folder.write("grid.json", grid(R"({"restitution": [{"law": "tc", "t_c": 1e-3},
                                                      {"law": "threshold", "speed": 1e-3}]})"));
  REQUIRE(campaign(folder, {"plan", "grid.json"}).exit_code == 0);
  CHECK(campaign(folder, {"run"}).exit_code == 0);
  CHECK(number(folder, "SELECT count(*) FROM jobs WHERE status = 'done' AND kind = 'cooling'") ==
        2);
  CHECK(number(folder, "SELECT count(*) FROM jobs WHERE kind = 'equilibration'") == 1);
  CHECK(number(folder, "SELECT count(*) FROM jobs WHERE effects ->> '$.restitution.law' = 'tc'") ==
        1);
  CHECK(number(folder,
               "SELECT count(*) FROM (SELECT temperature > lag(temperature) OVER (PARTITION BY "
               "job_id ORDER BY samples.tau) AS warmer FROM samples JOIN jobs USING (job_id) "
               "WHERE kind = 'cooling') WHERE warmer") == 0);
  CHECK(campaign(folder, {"verify"}).exit_code == 0);
}
