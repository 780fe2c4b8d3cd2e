// SPDX-License-Identifier: GPL-3.0-or-later

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "cli/program.hpp"

using namespace haff::tests;
using nlohmann::json;

namespace {

void plan(const Folder& folder) {
  folder.write("grid.json", R"({"e": [0.8, 0.9], "n": 0.4, "N": 500, "seeds": 2, "tau_max": 100})");
  REQUIRE(campaign(folder, {"plan", "grid.json"}).exit_code == 0);
}

json status(const Folder& folder) {
  const Outcome outcome = campaign(folder, {"status", "--json"});
  REQUIRE(outcome.exit_code == 0);
  return json::parse(outcome.out);
}

}  // namespace

TEST_CASE("status: after a plan all jobs are pending, and run comes next") {
  const Folder folder;
  plan(folder);
  const json now = status(folder);
  CHECK(now["jobs"]["pending"] == 6);
  CHECK(now["fraction_done"] == 0);
  CHECK(now["expected_cpu_seconds"] > 0);
  CHECK(now["next"] == json{"campaign run"});
}

TEST_CASE("status: a complete campaign has tau_c beside published values") {
  const Folder folder;
  plan(folder);
  REQUIRE(campaign(folder, {"run"}).exit_code == 0);
  const json now = status(folder);
  CHECK(now["jobs"]["done"] == 6);
  CHECK(now["fraction_done"] == 1);
  REQUIRE(now["series"].size() == 2);
  CHECK(now["series"][0]["published_tau_c"] == 58);
  CHECK(now["series"][1]["published_tau_c"] == 134);
  CHECK(now["series"][0]["realizations"] == 2);
  CHECK(now["next"] == json{"campaign figures"});
}

TEST_CASE("status: a failure is shown with its reason, the blocked jobs, and retry") {
  const Folder folder;
  plan(folder);
  edit_unnoticed(folder,
                 "UPDATE jobs SET status = 'failed', error = 'for a test' WHERE job_id = 1");
  const json now = status(folder);
  REQUIRE(now["failures"].size() == 1);
  CHECK(now["failures"][0]["error"] == "for a test");
  CHECK(now["blocked"].size() == 2);
  CHECK(now["next"] == json{"campaign retry", "campaign run"});
  const Outcome text = campaign(folder, {"status"});
  CHECK(text.out.find("job 1 (equilibration n=0.4 N=500 seed 1) failed: for a test") !=
        std::string::npos);
}
