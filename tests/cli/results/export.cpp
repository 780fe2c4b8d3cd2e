// SPDX-License-Identifier: GPL-3.0-or-later

// `campaign export`: the last stored state of a job as extended XYZ.
#include <doctest/doctest.h>

#include <cmath>
#include <iterator>
#include <sstream>
#include <vector>

#include "cli/program.hpp"

using namespace haff::tests;

namespace {

// One equilibration and one cooling job, done.
void run(const Folder& folder) {
  folder.write("grid.json", R"({"e": 0.8, "n": 0.4, "N": 500, "seeds": 1, "tau_max": 20})");
  REQUIRE(campaign(folder, {"plan", "grid.json"}).exit_code == 0);
  REQUIRE(campaign(folder, {"run"}).exit_code == 0);
}

}  // namespace

TEST_CASE("export: every particle in its box, with the energy of the sample") {
  const Folder folder;
  run(folder);
  const Outcome outcome = campaign(folder, {"export", "2"});
  CHECK(outcome.exit_code == 0);
  std::istringstream lines(outcome.out);
  std::string count, head;
  std::getline(lines, count);
  std::getline(lines, head);
  CHECK(count == "500");
  CHECK(head.starts_with("Lattice=\"10.7721734501594"));
  CHECK(head.find("Properties=id:I:1:pos:R:3:velo:R:3:radius:R:1:species:I:1:mass:R:1 ") !=
        std::string::npos);
  CHECK(head.find(" job_id=2 e=0.8 n=0.4 seed=1 tau=20 Time=") != std::string::npos);
  double squares = 0;
  int particles = 0;
  for (int id; lines >> id; ++particles) {
    CHECK(id == particles);
    double r[3], v[3], radius;
    for (double& x : r) {
      lines >> x;
      CHECK(x >= 0);
      CHECK(x < 10.7721735);
    }
    for (double& x : v) {
      lines >> x;
      squares += x * x;
    }
    double mass;
    int species;
    lines >> radius >> species >> mass;
    CHECK(radius == 0.5);
    CHECK(species == 1);
    CHECK(mass == 1);
  }
  CHECK(particles == 500);
  const double temperature =
      number(folder, "SELECT temperature FROM samples WHERE job_id = 2 AND tau = 20");
  CHECK(squares / 500 / 3 == doctest::Approx(temperature).epsilon(1e-12));
}

TEST_CASE("export: a rough mixture says which particles are of which species, and how they spin") {
  const Folder folder;
  folder.write("grid.json", R"({"e": 0.9, "n": 0.1, "N": 100, "seeds": 1, "tau_max": 20,
    "effects": {"mixture": {"fraction": 0.5, "diameter_ratio": 1, "mass_ratio": 0.1},
                "roughness": {"beta": 0.5, "q": 0.4}}})");
  REQUIRE(campaign(folder, {"plan", "grid.json"}).exit_code == 0);
  REQUIRE(campaign(folder, {"run"}).exit_code == 0);
  const Outcome outcome = campaign(folder, {"export", "2"});
  CHECK(outcome.exit_code == 0);
  std::istringstream lines(outcome.out);
  std::string count, head;
  std::getline(lines, count);
  std::getline(lines, head);
  CHECK(head.find(":species:I:1:mass:R:1:angular_velocity:R:3 ") != std::string::npos);
  CHECK(head.find("effects=\"{\\\"mixture\\\":") != std::string::npos);
  int second = 0;
  double spin = 0;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream numbers(line);
    std::vector<double> x{std::istream_iterator<double>(numbers), {}};
    REQUIRE(x.size() == 13);
    CHECK(x[9] == (x[8] == 2 ? 0.1 : 1.0));
    second += x[8] == 2;
    spin += std::abs(x[10]) + std::abs(x[11]) + std::abs(x[12]);
  }
  CHECK(second == 50);
  CHECK(spin > 0);
}

TEST_CASE("export: what there is not is bad input") {
  const Folder folder;
  run(folder);
  const Outcome unknown = campaign(folder, {"export", "99"});
  CHECK(unknown.exit_code == 2);
  CHECK(unknown.err.find("there is no job 99") != std::string::npos);
  CHECK(unknown.out.empty());
  CHECK(campaign(folder, {"export"}).exit_code == 2);
  CHECK(campaign(folder, {"export", "two"}).exit_code == 2);

  change(folder, "DELETE FROM checkpoint_chunks; DELETE FROM checkpoints");
  const Outcome early = campaign(folder, {"export", "2"});
  CHECK(early.exit_code == 2);
  CHECK(early.err.find("no state of job 2") != std::string::npos);
  CHECK(early.err.find("with: campaign run") != std::string::npos);
}

TEST_CASE("export: a damaged state is not written") {
  const Folder folder;
  run(folder);
  sabotage(folder, "UPDATE checkpoint_chunks SET bytes = zeroblob(length(bytes))");
  const Outcome outcome = campaign(folder, {"export", "2"});
  CHECK(outcome.exit_code == 1);
  CHECK(outcome.out.empty());
  CHECK(outcome.err.find("damaged") != std::string::npos);
}

TEST_CASE("export: a full disk is reported") {
  const Folder folder;
  run(folder);
  CHECK(shell(folder, "\"$campaign\" export 2 > /dev/full").exit_code == 1);
}
