// SPDX-License-Identifier: GPL-3.0-or-later

// `campaign export`: the last stored state of a job, and its snapshots, as extended XYZ.
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

TEST_CASE("export: every particle is in the box, and the energy is that of the sample") {
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
  CHECK(head.find("Properties=species:S:1:pos:R:3:velo:R:3:radius:R:1:mass:R:1:id:I:1 ") !=
        std::string::npos);
  CHECK(head.find(" job_id=2 e=0.8 n=0.4 seed=1 tau=20 Time=") != std::string::npos);
  double squares = 0;
  int particles = 0;
  for (std::string species; lines >> species; ++particles) {
    CHECK(species == "H");
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
    int id;
    lines >> radius >> mass >> id;
    CHECK(id == particles);
    CHECK(radius == 0.5);
    CHECK(mass == 1);
  }
  CHECK(particles == 500);
  const double temperature =
      number(folder, "SELECT temperature FROM samples WHERE job_id = 2 AND tau = 20");
  CHECK(squares / 500 / 3 == doctest::Approx(temperature).epsilon(1e-12));
}

TEST_CASE("export: a rough mixture is exported with species and spins") {
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
  CHECK(head.find(":mass:R:1:id:I:1:omega:R:3 ") != std::string::npos);
  CHECK(head.find("effects='{\"mixture\":") != std::string::npos);
  int second = 0;
  double spin = 0;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string species;
    words >> species;
    std::vector<double> x{std::istream_iterator<double>(words), {}};
    REQUIRE(x.size() == 12);
    CHECK(x[7] == (species == "He" ? 0.1 : 1.0));
    second += species == "He";
    spin += std::abs(x[9]) + std::abs(x[10]) + std::abs(x[11]);
  }
  CHECK(second == 50);
  CHECK(spin > 0);
}

TEST_CASE("export: a job or state that does not exist is bad input") {
  const Folder folder;
  run(folder);
  const Outcome unknown = campaign(folder, {"export", "99"});
  CHECK(unknown.exit_code == 2);
  CHECK(unknown.err.find("there is no job 99") != std::string::npos);
  CHECK(unknown.out.empty());
  CHECK(campaign(folder, {"export"}).exit_code == 2);
  CHECK(campaign(folder, {"export", "two"}).exit_code == 2);

  edit_unnoticed(folder, "DELETE FROM checkpoint_chunks; DELETE FROM checkpoints");
  const Outcome early = campaign(folder, {"export", "2"});
  CHECK(early.exit_code == 2);
  CHECK(early.err.find("no state of job 2") != std::string::npos);
  CHECK(early.err.find("with: campaign run") != std::string::npos);
  // If checkpoint_every is beyond the end of the job, its first state is its last one.
  edit_unnoticed(folder, "UPDATE jobs SET checkpoint_every = 1000");
  const Outcome late = campaign(folder, {"export", "1"});
  CHECK(late.err.find("first checkpoint, tau = 1000") == std::string::npos);
  CHECK(late.err.find("first checkpoint, tau = ") != std::string::npos);
}

TEST_CASE(
    "export: a job that ends before its first checkpoint has only snapshots, as the message says") {
  const Folder folder;
  folder.write("grid.json", R"({"e": 0.9, "n": 0.3, "N": 500, "seeds": 1, "tau_max": 5,
    "equilibrate": 10, "snapshots_at": 3})");
  REQUIRE(campaign(folder, {"plan", "grid.json"}).exit_code == 0);
  REQUIRE(campaign(folder, {"run"}).exit_code == 0);
  const Outcome last = campaign(folder, {"export", "2"});
  CHECK(last.exit_code == 2);
  CHECK(last.err.find("it ends at tau = 5; list the moments of interest in the grid's "
                      "\"snapshots_at\"") != std::string::npos);
  CHECK(campaign(folder, {"export", "2", "--at", "3"}).exit_code == 0);
}

TEST_CASE("export: a damaged state is not written") {
  const Folder folder;
  run(folder);
  edit_rows(folder, "UPDATE checkpoint_chunks SET bytes = zeroblob(length(bytes))");
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

// ---- snapshots --------------------------------------------------------------------------------

namespace {

void run_with_snapshots(const Folder& folder) {
  folder.write("grid.json", R"({"e": 0.8, "n": 0.4, "N": 500, "seeds": 1, "tau_max": 20,
    "snapshots_at": {"tau": [0, 2.5, 10], "time": [1.5]}})");
  REQUIRE(campaign(folder, {"plan", "grid.json"}).exit_code == 0);
  REQUIRE(campaign(folder, {"run"}).exit_code == 0);
}

// Reads extended XYZ as other programs do, by the names in the second line, and prints what it
// found: frames, particles, columns, cell, periodicity, tau, time, and the energy per particle.
constexpr const char* reader = R"(
import re, sys
frames = 0
lines = open(sys.argv[1]).read().split("\n")[:-1]
while lines:
    count = int(lines[0])
    facts = dict((k, v.strip('"')) for k, v in
                 re.findall(r'(\w+)=("(?:[^"\\]|\\.)*"|\S+)', lines[1]))
    kinds = facts["Properties"].split(":")
    columns, at = {}, 0
    for name, kind, width in zip(kinds[0::3], kinds[1::3], kinds[2::3]):
        columns[name] = (kind, at, int(width))
        at += int(width)
    energy, ids = 0.0, []
    for line in lines[2:2 + count]:
        words = line.split(" ")
        assert len(words) == at, (len(words), at)
        kind, begin, width = columns["velo"]
        _, mass, _ = columns["mass"]
        energy += 0.5 * float(words[mass]) * sum(float(v)**2 for v in words[begin:begin + width])
        ids.append(int(words[columns["id"][1]]))
    assert ids == list(range(count))
    print(count, facts["Lattice"].split()[0], facts["pbc"], facts["tau"], facts["Time"],
          repr(energy / count))
    lines = lines[2 + count:]
)";

}  // namespace

TEST_CASE("export: one snapshot, all snapshots as a trajectory, or a list of them") {
  const Folder folder;
  run_with_snapshots(folder);
  folder.write("read.py", reader);

  const Outcome list = campaign(folder, {"export", "2", "--list"});
  CHECK(list.exit_code == 0);
  CHECK(list.out.find(" 2.5  ") != std::string::npos);
  CHECK(list.out.find("last state") != std::string::npos);
  const Outcome json = campaign(folder, {"--json", "export", "2", "--list"});
  CHECK(json.out.find(R"("what": "snapshot")") != std::string::npos);

  const Outcome all =
      shell(folder, "\"$campaign\" export 2 --all > all.xyz && python3 read.py all.xyz");
  CAPTURE(all.err);
  REQUIRE(all.exit_code == 0);
  std::istringstream frames(all.out);
  std::vector<double> taus, times, energies;
  double cell;
  for (int count; frames >> count;) {
    std::string t1, t2, t3;
    frames >> cell >> t1 >> t2 >> t3 >> taus.emplace_back() >> times.emplace_back() >>
        energies.emplace_back();
    CHECK(count == 500);
    CHECK(t1 + t2 + t3 == "TTT");
  }
  REQUIRE(taus.size() == 4);
  CHECK(taus[0] == 0);
  CHECK(taus[1] == 2.5);
  CHECK(times[2] == 1.5);
  CHECK(taus[3] == 10);
  CHECK(energies[0] == doctest::Approx(1).epsilon(1e-13));
  // The temperature of the sample at the same collision; sums run in another order.
  const double temperature =
      number(folder, "SELECT temperature FROM samples WHERE job_id = 2 AND tau = 10");
  CHECK(energies[3] == doctest::Approx(1.5 * temperature).epsilon(1e-12));

  const Outcome one =
      shell(folder, "\"$campaign\" export 2 --at 2.5 > one.xyz && python3 read.py one.xyz");
  CHECK(one.out.find(" 2.5 ") != std::string::npos);
  const Outcome at_time = campaign(folder, {"export", "2", "--at-time", "1.5"});
  CHECK(at_time.out.find(" Time=1.5 ") != std::string::npos);
}

TEST_CASE("export: a snapshot that does not exist is named, with those that exist") {
  const Folder folder;
  run_with_snapshots(folder);
  const Outcome wrong = campaign(folder, {"export", "2", "--at", "3"});
  CHECK(wrong.exit_code == 2);
  CHECK(wrong.out.empty());
  CHECK(wrong.err.find("has no snapshot at tau = 3; there are those at tau = 0, 2.5, ") !=
        std::string::npos);
  const Outcome none = campaign(folder, {"export", "1", "--all"});
  CHECK(none.exit_code == 2);
  CHECK(none.err.find("its grid has no \"snapshots_at\"") != std::string::npos);
  CHECK(campaign(folder, {"export", "2", "--at", "3", "--all"}).exit_code == 2);
  CHECK(campaign(folder, {"export", "2", "--at", "x"}).exit_code == 2);
  CHECK(campaign(folder, {"--json", "export", "2"}).exit_code == 2);
}

TEST_CASE("export: a damaged snapshot is not written; verify finds it, and --repair repairs it") {
  const Folder folder;
  run_with_snapshots(folder);
  const std::string before = rows(folder);
  edit_rows(folder, "UPDATE snapshot_chunks SET bytes = zeroblob(length(bytes)) WHERE time = 1.5");
  const Outcome damaged = campaign(folder, {"export", "2", "--at-time", "1.5"});
  CHECK(damaged.exit_code == 1);
  CHECK(damaged.out.empty());
  CHECK(damaged.err.find("the snapshot of job 2") != std::string::npos);
  CHECK(campaign(folder, {"export", "2", "--at", "10"}).exit_code == 0);
  CHECK(campaign(folder, {"verify"}).exit_code == 1);
  CHECK(campaign(folder, {"verify", "--recompute", "2"}).out.find("damaged in the store") !=
        std::string::npos);
  CHECK(campaign(folder, {"verify", "--repair"}).exit_code == 0);
  CHECK(campaign(folder, {"verify"}).exit_code == 0);
  CHECK(rows(folder) == before);
}
