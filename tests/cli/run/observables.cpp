// SPDX-License-Identifier: GPL-3.0-or-later

// Every observable at once, on several threads and through kills.
#include <doctest/doctest.h>

#include <chrono>
#include <csignal>
#include <string>

#include "cli/program.hpp"

using namespace haff::tests;
using namespace std::chrono_literals;

namespace {

// A gas that is large enough for several threads: one second of work in all.
constexpr const char* everything = R"({
  "e": 0.8, "n": 0.4, "N": 2500, "seeds": 1, "tau_max": 60, "equilibrate": 10, "profiles_every": 15,
  "fields_at": 30,
  "effects": [{}, {"shuffle": {"every": 2}}, {"thermostat": {"rate": 0.05}},
              {"roughness": {"beta": 0.5, "q": 0.4}},
              {"mixture": {"fraction": 0.5, "diameter_ratio": 0.8, "mass_ratio": 0.5}}],
  "observables": ["temperature", "laguerre", "distribution", "tail", "correlations", "structure",
                  "pair_distribution", "energy_spectrum", "clusters", "cluster_sizes", "msd",
                  "msd@20", "vacf", "vacf@20", "fields")";

std::string grid(bool with_collisions) {
  return std::string(everything) + (with_collisions ? ", \"collision_statistics\"]}" : "]}");
}

void plan(const Folder& folder, bool with_collisions) {
  folder.write("grid.json", grid(with_collisions));
  const Outcome outcome = campaign(folder, {"plan", "grid.json"});
  CAPTURE(outcome.err);
  REQUIRE(outcome.exit_code == 0);
}

std::string rows_of_run(bool with_collisions) {
  const Folder folder;
  plan(folder, with_collisions);
  REQUIRE(campaign(folder, {"run", "--workers", "2"}).exit_code == 0);
  return rows(folder);
}

}  // namespace

TEST_CASE("observables: all of them, killed and resumed, on any number of threads") {
  for (const bool with_collisions : {false, true}) {
    CAPTURE(with_collisions);
    const std::string calm = rows_of_run(with_collisions);
    const Folder folder;
    plan(folder, with_collisions);
    int kills = 0;
    for (bool complete = false; !complete && kills < 40;) {
      Program run(folder, {"run", "--workers", "1", "--threads", kills % 2 == 0 ? "2" : "1"});
      sleep_for(std::chrono::milliseconds(150 + 50 * (kills % 4)));
      complete = !run.runs();
      if (complete) {
        CHECK(run.wait().exit_code == 0);
        break;
      }
      run.signal(SIGKILL);
      run.wait();
      ++kills;
    }
    CHECK(kills > 1);
    REQUIRE(campaign(folder, {"run", "--threads", "2"}).exit_code == 0);
    CHECK(campaign(folder, {"verify"}).exit_code == 0);
    CHECK(rows(folder) == calm);
  }
}

TEST_CASE("observables: collisions are counted on one thread, and the run says so") {
  const Folder folder;
  folder.write("grid.json", R"({"e": 0.8, "n": 0.4, "N": 500, "seeds": 1, "tau_max": 20,
    "observables": ["temperature", "collision_statistics"]})");
  REQUIRE(campaign(folder, {"plan", "grid.json"}).exit_code == 0);
  const Outcome outcome = campaign(folder, {"run", "--threads", "2"});
  CAPTURE(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err.find("runs on one thread: collision_statistics") != std::string::npos);
  // There are profiles at tau = 10 and 20, and none at 0.
  CHECK(number(folder, "SELECT count(*) FROM profiles WHERE name = 'impacts'") == 40);
  CHECK(campaign(folder, {"verify", "--recompute", "all"}).exit_code == 0);
}

TEST_CASE("observables: collision statistics are merged from shards, averaged and drawn") {
  const Folder folder, alone;
  for (const Folder* each : {&folder, &alone}) {
    each->write("grid.json", R"({"e": 0.8, "n": 0.4, "N": 500, "seeds": 3, "tau_max": 20,
      "observables": ["temperature", "collision_statistics"]})");
    REQUIRE(campaign(*each, {"plan", "grid.json"}).exit_code == 0);
  }
  REQUIRE(campaign(alone, {"run"}).exit_code == 0);
  REQUIRE(campaign(folder, {"split", "--into", "2"}).exit_code == 0);
  for (const char* shard : {"shards/shard-001.db", "shards/shard-002.db"})
    REQUIRE(campaign(folder, {"--store", shard, "run"}).exit_code == 0);
  REQUIRE(campaign(folder, {"merge", "shards/shard-001.db", "shards/shard-002.db"}).exit_code == 0);
  CHECK(rows(folder) == rows(alone));
  CHECK(number(folder,
               "SELECT count(*) FROM mean_profiles WHERE name = 'impacts' AND tau = 20 AND "
               "realizations = 3 AND value_se > 0") == 20);
  CHECK(number(folder, "SELECT avg(value) FROM mean_profiles WHERE name = 'impacts'") ==
        doctest::Approx(1).epsilon(1e-12));
  for (const char* name : {"free_times", "impacts", "normal_speeds"}) {
    CAPTURE(name);
    const Outcome plot =
        campaign(folder, {"plot", name, "--where", "tau = 20", "--theory", "--out", "curve.csv"});
    CHECK(plot.exit_code == 0);
    CHECK(shell(folder, "grep -q chaos curve.csv").exit_code == 0);
  }
}
