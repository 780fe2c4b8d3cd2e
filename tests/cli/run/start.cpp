// SPDX-License-Identifier: GPL-3.0-or-later

// The key start: the states from which jobs start.
#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <numbers>
#include <sstream>
#include <string>

#include "cli/program.hpp"

using namespace haff::tests;
using namespace std::chrono_literals;

namespace {

void plan(const Folder& folder, const std::string& grid) {
  folder.write("grid.json", grid);
  const Outcome outcome = campaign(folder, {"plan", "grid.json"});
  CAPTURE(outcome.err);
  REQUIRE(outcome.exit_code == 0);
}

void finish(const Folder& folder) {
  REQUIRE(campaign(folder, {"run"}).exit_code == 0);
  const Outcome verified = campaign(folder, {"verify"});
  CAPTURE(verified.out);
  REQUIRE(verified.exit_code == 0);
}

std::string complaint(const std::string& grid) {
  const Folder folder;
  folder.write("grid.json", grid);
  const Outcome outcome = campaign(folder, {"plan", "grid.json"});
  CHECK(outcome.exit_code == 2);
  return outcome.err;
}

}  // namespace

TEST_CASE("start: a crystal starts as a lattice, without an equilibration") {
  const Folder folder;
  plan(folder, R"({"e": 0.9, "n": 0.5, "N": 864, "seeds": 1, "tau_max": 10, "start": "crystal",
    "observables": ["temperature", "pair_distribution"]})");
  CHECK(number(folder, "SELECT equilibrate FROM jobs WHERE job_id = 1") == 0);
  finish(folder);
  CHECK(number(folder, "SELECT tau_reached FROM jobs WHERE job_id = 1") == 0);
  // A face-centred cubic lattice of 6^3 cells: the nearest neighbours are 12, at a/sqrt(2).
  const double a = std::cbrt(864 / 0.5) / 6, nearest = a / std::sqrt(2.0);
  const std::string g = "FROM profiles WHERE job_id = 2 AND name = 'g' AND tau = 0 AND value > 0";
  CHECK(number(folder, "SELECT min(x) " + g + " AND x > 1") ==
        doctest::Approx(nearest).epsilon(0.025 / nearest));  // half a bin
  // 4 pi n sum r^2 g dr over the first shell is the number of nearest neighbours.
  CHECK(number(folder, "SELECT sum(value * 0.05 * 4 * 3.14159265358979 * 0.5 * x * x) " + g +
                           " AND x > 1 AND x < " + std::to_string(0.5 * (nearest + a))) ==
        doctest::Approx(12).epsilon(0.002));  // x^2 replaces its mean over a bin
  CHECK(number(folder, "SELECT temperature FROM samples WHERE job_id = 2 AND tau = 0") ==
        doctest::Approx(2.0 / 3).epsilon(1e-13));
}

TEST_CASE("start: two temperatures begin at their ratio, and become equal") {
  const Folder folder;
  plan(folder, R"({"e": 1, "n": 0.2, "N": 4000, "seeds": 1, "tau_max": 20,
    "equilibrate": 10, "start": {"two temperatures": {"ratio": 9}}, "observables": "temperature",
    "effects": {"mixture": {"fraction": 0.5, "diameter_ratio": 1, "mass_ratio": 1}}})");
  finish(folder);
  const auto ratio = [&](const char* tau) {
    return number(folder, std::string("SELECT temperature_1 / temperature_2 FROM samples WHERE "
                                      "job_id = 2 AND tau = ") +
                              tau);
  };
  CHECK(ratio("0") == doctest::Approx(9).epsilon(1e-12));
  CHECK(ratio("1") < 9);
  CHECK(ratio("3") < ratio("1"));
  // They are equal up to noise: the ratio of two temperatures of 2000 particles each has a standard
  // error of sqrt(2 * 2/(3 * 2000)) = 0.026; five of these are allowed.
  CHECK(std::abs(ratio("20") - 1) < 0.13);
  CHECK(number(folder, "SELECT max(abs(temperature - 2.0 / 3)) FROM samples WHERE job_id = 2") <
        1e-12);
}

namespace {

// 2/N sum v_x sin(2 pi y / L) of a snapshot.
double amplitude(const Folder& folder, const std::string& time) {
  const Outcome outcome = campaign(folder, {"export", "2", "--at-time", time});
  REQUIRE(outcome.exit_code == 0);
  std::istringstream lines(outcome.out);
  double count = 0, sum = 0;
  std::string rest;
  lines >> count;
  std::getline(lines, rest);
  std::getline(lines, rest);
  const double side = std::stod(rest.substr(rest.find('"') + 1));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string species;
    double x, y, z, v;
    words >> species >> x >> y >> z >> v;
    sum += v * std::sin(2 * std::numbers::pi * y / side);
  }
  return 2 * sum / count;
}

}  // namespace

TEST_CASE("start: a shear wave decays by Enskog's viscosity") {
  const Folder folder;
  plan(folder, R"({"e": 1, "n": 0.4, "N": 16000, "seeds": 1, "tau_max": 140, "equilibrate": 20,
    "sample_every": 10, "observables": "temperature", "start": {"shear wave": {"amplitude": 1}},
    "snapshots_at": {"time": [0, 10, 30]}})");
  finish(folder);
  // nu/sqrt(T) of Enskog's theory at n = 0.4, from which the gas itself differs by some 2 %. The
  // rest of the energy is heat: 3/2 T + A^2/4 = 1. dA/dt = -nu k^2 A in steps of 0.01.
  constexpr double nu = 0.9809, step = 0.01;
  const double k = 2 * std::numbers::pi / std::cbrt(16000 / 0.4);
  double a = 1;
  const auto to = [&](double from, double end) {
    for (double t = from; t < end - step / 2; t += step)
      a -= step * nu * std::sqrt(2.0 / 3 * (1 - a * a / 4)) * k * k * a;
    return a;
  };
  // Thermal motion has an amplitude of sqrt(2 T/N) = 0.009 in this mode. At the start it adds to
  // the wave; later five times this amplitude is allowed, plus 2 % of the decay.
  constexpr double allowed = 0.045;
  CHECK(std::abs(amplitude(folder, "0") - 1) < allowed);
  CHECK(std::abs(amplitude(folder, "10") - to(0, 10)) < allowed);
  CHECK(std::abs(amplitude(folder, "30") - to(10, 30)) < allowed);
}

TEST_CASE(
    "start: each start makes its own series, and all that equilibrate share an equilibration") {
  const Folder folder;
  plan(folder, R"({"e": 0.9, "n": 0.3, "N": 500, "seeds": 2, "tau_max": 10, "equilibrate": 10,
    "start": ["uniform", "shear wave", {"shear wave": {"amplitude": 0.2, "waves": 2}},
              "two temperatures", "crystal"]})");
  CHECK(number(folder, "SELECT count(*) FROM jobs WHERE kind = 'equilibration'") == 4);
  CHECK(number(folder, "SELECT count(*) FROM jobs WHERE kind = 'cooling'") == 10);
  finish(folder);
  CHECK(number(folder, "SELECT count(*) FROM mean_series WHERE tau = 0") == 5);
  CHECK(number(folder, "SELECT count(gamma_ratio) FROM mean_series WHERE start LIKE '%shear%'") ==
        0);
  CHECK(number(folder, "SELECT count(gamma_ratio) FROM mean_series WHERE start IS NULL") == 10);
  CHECK(campaign(folder, {"verify", "--recompute", "all"}).exit_code == 0);
  CHECK(campaign(folder, {"status"}).exit_code == 0);
  CHECK(campaign(folder, {"plot", "a2", "--out", "a2.csv"}).exit_code == 0);
  plan(folder, R"({"e": 0.9, "n": 0.3, "N": 500, "seeds": 2, "tau_max": 10, "equilibrate": 10})");
  CHECK(number(folder, "SELECT count(*) FROM jobs") == 14);  // uniform is the default
}

TEST_CASE("start: a file that export wrote is in the store from then on") {
  const Folder folder;
  plan(folder, R"({"e": 0.8, "n": 0.3, "N": 500, "seeds": 1, "tau_max": 20, "equilibrate": 10,
    "snapshots_at": 7})");
  finish(folder);
  REQUIRE(shell(folder, "\"$campaign\" export 2 --at 7 > gas.xyz").exit_code == 0);
  const std::string grid = R"({"e": [0.9, 1], "n": 0.3, "N": 500, "seeds": 1, "tau_max": 20,
    "start": {"file": "gas.xyz"}})";
  plan(folder, grid);
  CHECK(number(folder,
               "SELECT count(*) FROM jobs WHERE kind = 'equilibration' AND status = 'done'") == 2);
  REQUIRE(shell(folder, "mv gas.xyz elsewhere.xyz").exit_code == 0);
  finish(folder);
  const std::string before = rows(folder);
  CHECK(number(folder,
               "SELECT temperature FROM samples JOIN jobs USING (job_id) WHERE e = 0.9 AND "
               "tau = 0") == doctest::Approx(2.0 / 3).epsilon(1e-13));
  // The velocities are those of the snapshot, scaled, and have the same a2.
  CHECK(
      number(folder, "SELECT a2 FROM samples JOIN jobs USING (job_id) WHERE e = 0.9 AND tau = 0") ==
      doctest::Approx(number(folder, "SELECT a2 FROM samples WHERE job_id = 2 AND tau = 7"))
          .epsilon(1e-9));
  CHECK(campaign(folder, {"verify", "--recompute", "all"}).exit_code == 0);

  // A file with other numbers is another job; the same numbers under another name are the same job.
  REQUIRE(shell(folder, "cp elsewhere.xyz gas.xyz").exit_code == 0);
  CHECK(shell(folder, "\"$campaign\" plan grid.json").out.find("nothing was added") !=
        std::string::npos);
  // A damaged state is restored from the file.
  edit_rows(folder,
            "UPDATE checkpoint_chunks SET bytes = zeroblob(length(bytes)) WHERE job_id IN "
            "(SELECT job_id FROM jobs WHERE start LIKE '%file%' AND kind = 'equilibration')");
  CHECK(campaign(folder, {"verify"}).exit_code == 1);
  REQUIRE(campaign(folder, {"plan", "grid.json"}).exit_code == 0);
  CHECK(campaign(folder, {"verify"}).exit_code == 0);
  CHECK(rows(folder) == before);
}

TEST_CASE("start: killed and resumed, on one thread or two, each start ends with the same bits") {
  // A gas that is large enough for two threads; a rough mixture, so that a file has all columns.
  const std::string gas = R"("e": 0.8, "n": 0.4, "N": 2500, "seeds": 1, "equilibrate": 10,
    "checkpoint_every": 5, "effects": {"roughness": {"beta": 0.5, "q": 0.4},
    "mixture": {"fraction": 0.5, "diameter_ratio": 0.8, "mass_ratio": 0.5}})";
  const Folder before;
  plan(before, "{" + gas + R"(, "tau_max": 5, "snapshots_at": 5})");
  finish(before);
  REQUIRE(shell(before, "\"$campaign\" export 2 --at 5 > gas.xyz").exit_code == 0);
  const Folder calm, folder;
  for (const Folder* each : {&calm, &folder}) {
    std::filesystem::copy(before / "gas.xyz", *each / "gas.xyz");
    plan(*each, "{" + gas + R"(, "tau_max": 40, "start": [{"file": "gas.xyz"}, "crystal",
      "shear wave", "two temperatures"]})");
  }
  REQUIRE(campaign(calm, {"run"}).exit_code == 0);
  int kills = 0;
  for (bool complete = false; !complete && kills < 40;) {
    Program run(folder, {"run", "--workers", "1", "--threads", kills % 2 == 0 ? "2" : "1"});
    sleep_for(100ms + 50ms * (kills % 4));
    complete = !run.runs();
    if (!complete) {
      run.signal(SIGKILL);
      ++kills;
    }
    run.wait();
  }
  CHECK(kills > 1);
  REQUIRE(campaign(folder, {"run", "--threads", "2"}).exit_code == 0);
  CHECK(campaign(folder, {"verify"}).exit_code == 0);
  CHECK(rows(folder) == rows(calm));
}

TEST_CASE("start: a bad start is refused, with its place in the grid and in the file") {
  const std::string rest = R"("e": 0.9, "n": 0.3, "N": 500, "tau_max": 10, )";
  CHECK(complaint("{" + rest + R"("seeds": 1, "start": {"file": "none.xyz"}})")
            .find("grid.json: /start/file: none.xyz: cannot be read: No such file") !=
        std::string::npos);
  CHECK(complaint("{" + rest + R"("seeds": 2, "start": {"file": "none.xyz"}})")
            .find("/seeds: 2 makes realizations that are all the same") != std::string::npos);
  CHECK(complaint("{" + rest + R"("seeds": 1, "equilibrate": 20, "start": "crystal"})")
            .find("/equilibrate: 20 does not go together with \"start\": \"crystal\"") !=
        std::string::npos);
  CHECK(complaint("{" + rest + R"("seeds": 1, "start": "sheer wave"})").find("shear wave") !=
        std::string::npos);
  CHECK(
      complaint("{" + rest + R"("seeds": 1, "start": {"shear wave": {"amplitude": 2}}})")
          .find("/start/shear wave/amplitude: 2 is not accepted; expected an amplitude above 0 and "
                "at most 1.9") != std::string::npos);
  CHECK(complaint(R"({"e": 0.9, "n": 1.3, "N": 501, "seeds": 1, "tau_max": 9, "start": "crystal",
                      "d": 3})")
            .find("/N") != std::string::npos);
}
