// SPDX-License-Identifier: GPL-3.0-or-later

// Samples and snapshots at moments of their own: sample_at and snapshots_at.
#include <doctest/doctest.h>

#include <csignal>
#include <string>

#include "cli/program.hpp"

using namespace haff::tests;
using namespace std::chrono_literals;

namespace {

std::string grid(int tau_max, const std::string& rest) {
  return R"({"e": 0.8, "n": 0.3, "N": 2000, "seeds": 1, "equilibrate": 10, "tau_max": )" +
         std::to_string(tau_max) + rest + "}";
}

constexpr const char* moments = R"(, "observables": ["temperature", "laguerre", "msd"],
  "sample_at": {"tau": {"log": 5}, "time": {"log": 5}},
  "snapshots_at": {"tau": [0, 0.25, 13], "time": [1, 17.5]})";

void plan(const Folder& folder, const std::string& text) {
  folder.write("grid.json", text);
  REQUIRE(campaign(folder, {"plan", "grid.json"}).exit_code == 0);
}

void finish(const Folder& folder, const std::string& threads = "1") {
  REQUIRE(campaign(folder, {"run", "--threads", threads}).exit_code == 0);
  REQUIRE(campaign(folder, {"verify"}).exit_code == 0);
}

}  // namespace

TEST_CASE("moments: further samples change the other samples only in averages over intervals") {
  const Folder with, without;
  plan(with, grid(30, moments));
  plan(without, grid(30, ""));
  finish(with);
  finish(without);
  for (const char* column : {"time", "temperature", "a2"}) {
    const std::string sum = std::string("SELECT sum(") + column +
                            " * (1 + tau)) FROM (SELECT * FROM samples WHERE job_id = 2 AND tau = "
                            "round(tau) ORDER BY tau)";
    CHECK(number(with, sum) == number(without, sum));
  }
  CHECK(number(with, "SELECT count(*) FROM samples WHERE job_id = 2") == 31 + 11);
  CHECK(number(with, "SELECT count(*) FROM samples WHERE job_id = 2 AND tau = 1.585") == 1);
  // The rate over an interval is the mean of the rates over its parts.
  CHECK(number(with,
               "SELECT sum(collision_rate * dt) / sum(dt) FROM (SELECT collision_rate, tau, "
               "time - lag(time) OVER (ORDER BY tau) AS dt FROM samples WHERE job_id = 2) "
               "WHERE tau > 2 AND tau <= 3") ==
        doctest::Approx(number(without,
                               "SELECT collision_rate FROM samples WHERE job_id = 2 AND "
                               "tau = 3"))
            .epsilon(1e-12));
}

TEST_CASE("moments: killed, stopped and extended, with any number of threads, the same bits") {
  const Folder calm;
  plan(calm, grid(40, moments));
  finish(calm);
  const std::string expected = rows(calm);
  for (const char* threads : {"1", "2"}) {
    CAPTURE(threads);
    const Folder folder;
    plan(folder, grid(20, moments));
    Program first(folder, {"run", "--threads", threads});
    while (first.runs() && number(folder, "SELECT count(*) FROM snapshots") == 0) sleep_for(1ms);
    const auto workers = first.workers();
    first.signal(SIGKILL);
    for (const pid_t worker : workers) kill(worker, SIGKILL);
    first.wait();
    Program second(folder, {"run", "--threads", threads});
    sleep_for(30ms);
    second.signal(SIGTERM);
    second.wait();
    finish(folder, threads);
    plan(folder, grid(40, moments));
    finish(folder, threads);
    CHECK(rows(folder) == expected);
    CHECK(campaign(folder, {"verify", "--recompute", "all"}).out.find("every bit the same") !=
          std::string::npos);
  }
}

TEST_CASE("moments: realizations are averaged at equal tau and at equal time") {
  const Folder folder;
  folder.write("grid.json", R"({"e": 0.8, "n": 0.3, "N": 500, "seeds": 3, "equilibrate": 10,
    "tau_max": 20, "sample_every": 20, "sample_at": {"tau": {"log": 4}, "time": [0, 0.5, 5]}})");
  REQUIRE(campaign(folder, {"plan", "grid.json"}).exit_code == 0);
  finish(folder);
  CHECK(number(folder, "SELECT min(realizations) FROM mean_series") == 3);
  // 0, ten from 0.1 to 17.78, 20
  CHECK(number(folder, "SELECT count(*) FROM mean_series") == 12);
  CHECK(number(folder,
               "SELECT count(*) FROM mean_profiles WHERE name = 'temperature_at_time' AND "
               "realizations = 3") == 3);
  CHECK(number(folder,
               "SELECT value FROM mean_profiles WHERE name = 'temperature_at_time' AND x = "
               "0") == doctest::Approx(2.0 / 3).epsilon(1e-12));
  const Outcome plot = campaign(folder, {"plot", "temperature_at_time", "--out", "t.csv"});
  CAPTURE(plot.err);
  CHECK(plot.exit_code == 0);
  CHECK(campaign(folder, {"plot", "gamma_ratio", "--out", "g.csv"}).exit_code == 0);
  CHECK(campaign(folder, {"figures"}).exit_code == 0);
  CHECK(campaign(folder, {"status"}).exit_code == 0);
}
