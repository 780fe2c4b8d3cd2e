// SPDX-License-Identifier: GPL-3.0-or-later

#include <doctest/doctest.h>

#include "cli/program.hpp"

using namespace haff::tests;

namespace {

constexpr const char* grid = R"({"e": [0.8, 0.9], "n": 0.4, "N": 500, "seeds": 2, "tau_max": 20})";

double count(const Folder& folder, const std::string& where) {
  return number(folder, "SELECT count(*) FROM jobs WHERE " + where);
}

}  // namespace

TEST_CASE("plan: adds equilibrations once for all e") {
  const Folder folder;
  folder.write("grid.json", grid);
  const Outcome outcome = campaign(folder, {"plan", "grid.json"});
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out.find("6 jobs: 6 added.") != std::string::npos);
  CHECK(count(folder, "kind = 'equilibration'") == 2);
  CHECK(count(folder, "kind = 'cooling'") == 4);
}

TEST_CASE("plan: a second one adds nothing and says so") {
  const Folder folder;
  folder.write("grid.json", grid);
  campaign(folder, {"plan", "grid.json"});
  const Outcome outcome = campaign(folder, {"plan", "grid.json"});
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out.find("nothing was added") != std::string::npos);
  CHECK(count(folder, "1") == 6);
}

TEST_CASE("plan: a larger grid adds the difference") {
  const Folder folder;
  folder.write("grid.json", grid);
  folder.write("larger.json",
               R"({"e": [0.8, 0.9], "n": 0.4, "N": 500, "seeds": 3, "tau_max": 20})");
  campaign(folder, {"plan", "grid.json"});
  const Outcome outcome = campaign(folder, {"plan", "larger.json"});
  CHECK(outcome.out.find("9 jobs: 3 added, 6 already there.") != std::string::npos);
  CHECK(count(folder, "1") == 9);
}

TEST_CASE("plan: a job named by two grids is one job with the larger tau_max") {
  const Folder folder;
  folder.write("grid.json", R"({"n": 0.4, "N": 500, "seeds": 1, "e": 0.8,
                                "grids": [{"tau_max": 30}, {"tau_max": 20}]})");
  campaign(folder, {"plan", "grid.json"});
  CHECK(count(folder, "kind = 'cooling'") == 1);
  CHECK(count(folder, "kind = 'cooling' AND tau_max = 30") == 1);
}

TEST_CASE("plan: --dry-run makes no store") {
  const Folder folder;
  folder.write("grid.json", grid);
  const Outcome outcome = campaign(folder, {"plan", "grid.json", "--dry-run"});
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out.find("6 jobs: 6 would be added.") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(folder.store()));
}

TEST_CASE("plan: --dry-run adds nothing to a store") {
  const Folder folder;
  folder.write("grid.json", grid);
  folder.write("larger.json", R"({"e": 0.8, "n": 0.4, "N": 500, "seeds": 3, "tau_max": 40})");
  campaign(folder, {"plan", "grid.json"});
  const Outcome outcome = campaign(folder, {"plan", "larger.json", "--dry-run"});
  CHECK(outcome.out.find("2 would be added, 2 extended to a larger tau_max") != std::string::npos);
  CHECK(count(folder, "1") == 6);
  CHECK(count(folder, "tau_max = 40") == 0);
}

TEST_CASE("plan: a bad grid ends with one message and no store") {
  const Folder folder;
  folder.write("grid.json", R"({"e": 1.5, "n": 0.4, "N": 500, "seeds": 1, "tau_max": 20})");
  const Outcome outcome = campaign(folder, {"plan", "grid.json"});
  CHECK(outcome.exit_code == 2);
  CHECK(outcome.err.find("grid.json") != std::string::npos);
  CHECK(outcome.err.find("/e") != std::string::npos);
  CHECK(outcome.err.find("1.5") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(folder.store()));
}

TEST_CASE("plan: a bad grid does not change a store") {
  const Folder folder;
  folder.write("grid.json", grid);
  folder.write("bad.json", R"({"e": 0.8, "n": 0.4, "N": 500, "seed": 9, "tau_max": 20})");
  campaign(folder, {"plan", "grid.json"});
  const Outcome outcome = campaign(folder, {"plan", "bad.json"});
  CHECK(outcome.exit_code == 2);
  CHECK(outcome.err.find("seeds") != std::string::npos);  // the nearest known key
  CHECK(count(folder, "1") == 6);
}

TEST_CASE("plan: a store that cannot be made is bad input") {
  const Folder folder;
  folder.write("grid.json", grid);
  const Outcome outcome = campaign(folder, {"plan", "grid.json", "--store", "no/folder/x.db"});
  CHECK(outcome.exit_code == 2);
  CHECK(outcome.err.find("no/folder/x.db") != std::string::npos);
}

TEST_CASE("plan: a dense mixture of small spheres is planned by what fills the box, and runs") {
  const Folder folder;
  folder.write("grid.json", R"({"e": 0.9, "n": 3, "N": 1008, "seeds": 1, "tau_max": 10,
    "equilibrate": 10, "observables": ["temperature", "laguerre", "msd", "pair_distribution"],
    "sample_at": {"time": {"log": 2}}, "effects":
    {"mixture": {"fraction": 0.857, "diameter_ratio": 0.4, "mass_ratio": 0.064}}})");
  for (const char* command :
       {"plan grid.json", "run", "status", "verify", "report", "plot Z --theory --out z.csv",
        "plot g_12 --against r --out g.csv", "plot energy --against time --theory --out t.csv"}) {
    CAPTURE(command);
    const Outcome outcome = shell(folder, std::string("\"$campaign\" ") + command);
    CAPTURE(outcome.err);
    CHECK(outcome.exit_code == 0);
  }
}
