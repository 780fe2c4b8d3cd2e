// SPDX-License-Identifier: GPL-3.0-or-later

#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

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

TEST_CASE("plan: a dense mixture of small spheres is accepted by its packing fraction, and runs") {
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

namespace {

// Memory and disk as `plan` predicts them, and as `run` uses them with one worker.
struct Taken {
  double planned = 0, measured = 0;
};

struct Sizes {
  Taken memory, disk;
};

Sizes sizes_of(const std::string& rest) {
  const Folder folder;
  folder.write("grid.json", R"({"e": 0.9, "seeds": 1, )" + rest + "}");
  const Outcome plan = campaign(folder, {"plan", "grid.json", "--json"});
  CAPTURE(plan.err);
  REQUIRE(plan.exit_code == 0);
  const auto json = nlohmann::json::parse(plan.out);
  const Outcome run = campaign(folder, {"run", "--workers", "1", "--threads", "1"});
  REQUIRE(run.exit_code == 0);
  return {{json["memory_bytes_of_worker"], run.peak_bytes},
          {json["disk_bytes"], static_cast<double>(std::filesystem::file_size(folder.store()))}};
}

}  // namespace

TEST_CASE("plan: memory and disk are predicted within 15 %, for every effect and observable") {
  const std::string gas = R"("n": 0.4, "N": 10000, "tau_max": 10, "equilibrate": 10)";
  for (const std::string& scene : {
           gas,
           gas + R"(, "d": 2)",
           gas + R"(, "effects": {"shuffle": {"every": 2}})",
           gas + R"(, "effects": {"thermostat": {"rate": 0.05}})",
           gas + R"(, "effects": {"roughness": {"beta": 0.5, "q": 0.4}})",
           gas + R"(, "effects": {"mixture": {"fraction": 0.5, "diameter_ratio": 0.8,
                                              "mass_ratio": 0.5}})",
           gas + R"(, "profiles_every": 5, "observables": ["temperature", "laguerre",
                      "distribution", "tail", "clusters", "cluster_sizes"])",
           gas + R"(, "profiles_every": 5, "observables": ["temperature", "correlations",
                      "structure", "energy_spectrum", "pair_distribution"])",
           gas + R"(, "observables": ["temperature", "msd", "vacf", "collision_statistics"])",
           gas + R"(, "fields_at": [5, 10], "observables": ["temperature", "fields"])",
           gas + R"(, "snapshots_at": [1, 2, 5, 10])",
           std::string(R"("n": 0.4, "N": 10000, "tau_max": 10, "start": "crystal")"),
           std::string(R"("n": 0.4, "N": 1000, "tau_max": 100, "sample_every": 0.1)"),
           std::string(R"("n": 0.001, "N": 10000, "tau_max": 10, "profiles_every": 5,
                          "observables": ["temperature", "correlations", "structure"])"),
           std::string(R"("n": 0.4, "N": 50000, "tau_max": 10)"),
       }) {
    CAPTURE(scene);
    const Sizes sizes = sizes_of(scene);
    CAPTURE(sizes.memory.planned);
    CAPTURE(sizes.memory.measured);
    CHECK(std::abs(sizes.memory.planned / sizes.memory.measured - 1) < 0.15);
    CAPTURE(sizes.disk.planned);
    CAPTURE(sizes.disk.measured);
    CHECK(std::abs(sizes.disk.planned / sizes.disk.measured - 1) < 0.15);
  }
}
