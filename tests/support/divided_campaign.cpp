// SPDX-License-Identifier: GPL-3.0-or-later

#include "support/divided_campaign.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

namespace haff::tests {

using namespace std::chrono_literals;

const std::string grid_with_everything = R"({
  "n": 0.3, "N": 500, "seeds": 3, "equilibrate": 20, "checkpoint_every": 10,
  "grids": [
    {"e": [0.8, 0.95], "tau_max": 60, "profiles_every": 20, "fields_at": [20],
      "sample_at": {"tau": {"log": 3}, "time": {"log": 2}}, "snapshots_at": [5, 25], "observables":
      ["temperature", "laguerre", "distribution", "correlations", "clusters", "fields"]},
    {"e": 0.7, "tau_max": 60, "effects": {"roughness": {"beta": 0.5, "q": 0.4}}},
    {"e": 0.9, "seeds": 5, "tau_max": 15, "target": {"a2": {"tau": [5, 15], "se": 0.005}}}]})";

const std::string long_grid = R"({
  "e": [0.9, 0.95], "n": 0.4, "N": 500, "seeds": 3, "tau_max": 2000, "sample_every": 10,
  "checkpoint_every": 10, "observables": ["temperature"]})";

std::string random_grid(std::mt19937& random) {
  const auto one_of = [&](const std::vector<std::string>& words) {
    return words[random() % words.size()];
  };
  std::string scenes;
  const auto count = 1 + random() % 3;
  for (std::size_t i = 0; i < count; ++i) {
    scenes += i == 0 ? "" : ",\n";
    scenes += R"({"e": )" + one_of({"0.7", "0.9", "[0.8, 0.95]"});
    scenes += R"(, "n": )" + one_of({"0.1", "0.3", "[0.2, 0.4]"});
    scenes += R"(, "tau_max": )" + one_of({"7", "20", "45"});
    scenes += R"(, "checkpoint_every": )" + one_of({"5", "10", "20"});
    if (random() % 2 == 0)
      scenes +=
          R"(, "effects": )" +
          one_of({R"({"roughness": {"beta": 0.5, "q": 0.4}})", R"({"shuffle": {"every": 2}})",
                  R"({"thermostat": {"rate": 0.05}})",
                  R"({"mixture": {"fraction": 0.5, "diameter_ratio": 0.8, "mass_ratio": 0.1}})"});
    else if (random() % 2 == 0)
      scenes += R"(, "profiles_every": 5, "fields_at": [5], "observables": ["temperature",
        "laguerre", "distribution", "correlations", "clusters", "fields"])";
    scenes += "}";
  }
  return R"({"N": )" + one_of({"200", "500"}) + R"(, "seeds": )" + one_of({"1", "2", "3"}) +
         R"(, "equilibrate": 20, "grids": [)" + scenes + "]}";
}

void plan(const Folder& folder, const std::string& grid) {
  folder.write("grid.json", grid);
  const Outcome planned = campaign(folder, {"plan", "grid.json"});
  REQUIRE_MESSAGE(planned.exit_code == 0, planned.err);
}

std::string undisturbed_rows(const std::string& grid) {
  const Folder folder;
  plan(folder, grid);
  REQUIRE(campaign(folder, {"run", "--workers", "2"}).exit_code == 0);
  return rows(folder);
}

Outcome submit(const Folder& folder, const std::string& time, std::vector<std::string> further) {
  std::vector<std::string> words{"submit", "--tasks",          "3", "--cpus", "1", "--time",
                                 time,     "--put-back-every", "1s"};
  words.insert(words.end(), further.begin(), further.end());
  return campaign(folder, words);
}

std::string tasks_job(const Folder& folder, int round) {
  std::ifstream record(folder / ("shards/round-00" + std::to_string(round) + ".json"));
  return nlohmann::json::parse(record).at("tasks_job").get<std::string>();
}

void wait_for_running(const Folder& folder, const std::string& partition, int count) {
  const std::string ask =
      "squeue --noheader --me --array --states=RUNNING --partition=" + partition + " | wc -l";
  for (int patience = 0; patience < 1000; ++patience) {
    if (std::stoi(shell(folder, ask).out) >= count) return;
    sleep_for(200ms);
  }
  FAIL("not " << count << " tasks of " << partition << " run:\n" << logs(folder));
}

namespace {

// Waits until a query of a shard in the user's folder gives this number.
void wait_for_count(const Folder& folder, const std::string& shard, const std::string& query,
                    int count) {
  const std::string ask = "sqlite3 shards/" + shard + ".db \"" + query + "\"";
  for (int patience = 0; patience < 600; ++patience) {
    const Outcome seen = shell(folder, ask);
    if (seen.exit_code == 0 && std::stoi(seen.out) >= count) return;
    sleep_for(100ms);
  }
  FAIL(shard << " is not put back:\n" << logs(folder));
}

}  // namespace

void wait_for_states(const Folder& folder, const std::string& shard, int count) {
  wait_for_count(folder, shard, "SELECT count(*) FROM checkpoints", count);
}

void wait_for_cooling(const Folder& folder, const std::string& shard) {
  wait_for_count(folder, shard,
                 "SELECT count(*) FROM jobs JOIN checkpoints USING (job_id) "
                 "WHERE kind = 'cooling' AND status <> 'done'",
                 1);
}

std::string logs(const Folder& folder) {
  return shell(folder, "tail -n 30 shards/*.log").out;
}

namespace {

// The shards in a folder, in random order.
std::vector<std::string> shuffled_shards(const Folder& folder, const std::string& in,
                                         std::mt19937& random) {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder / in))
    if (entry.path().extension() == ".db") paths.push_back(entry.path().string());
  std::ranges::sort(paths);
  std::ranges::shuffle(paths, random);
  return paths;
}

}  // namespace

bool kill_after(const Folder& folder, std::vector<std::string> words,
                std::chrono::milliseconds time) {
  Program program(folder, std::move(words));
  sleep_for(time);
  const auto workers = program.workers();
  program.signal(SIGKILL);
  const bool was_at_work = program.wait().exit_code == 128 + SIGKILL;
  for (const pid_t worker : workers)
    for (int patience = 0; is_alive(worker) && patience < 400; ++patience) sleep_for(5ms);
  return was_at_work;
}

namespace {

// Divides, runs, kills, merges and recalls at random until nothing is pending or lent. Returns how
// many merges were killed at work.
int run_random_campaign(const Folder& folder, std::mt19937& random) {
  int killed = 0;
  const auto some = [&](unsigned most) { return std::chrono::milliseconds(random() % most); };
  for (int round = 0;; ++round) {
    REQUIRE_MESSAGE(round < 60, "the campaign does not come to an end");
    const std::string out = "round-" + std::to_string(round);
    REQUIRE(campaign(folder, {"split", "--into", std::to_string(1 + random() % 4), "--out", out})
                .exit_code == 0);
    if (!std::filesystem::exists(folder / out)) break;
    for (const std::string& shard : shuffled_shards(folder, out, random)) {
      if (random() % 4 == 0) continue;  // this one is lost before it has begun
      if (random() % 2 == 0)
        kill_after(folder, {"run", "--store", shard}, some(60));
      else
        CHECK(campaign(folder, {"run", "--store", shard}).exit_code == 0);
    }
    for (int again = 0; again < 2; ++again)
      for (const std::string& shard : shuffled_shards(folder, out, random)) {
        if (random() % 2 == 0) killed += kill_after(folder, {"merge", shard}, some(12)) ? 1 : 0;
        if (random() % 4 > 0) CHECK(campaign(folder, {"merge", shard}).exit_code == 0);
      }
    for (const std::string& shard : shuffled_shards(folder, out, random)) {
      if (random() % 3 == 0) std::filesystem::remove(shard);
      CHECK(campaign(folder, {"recall", shard}).exit_code == 0);
    }
    if (random() % 3 == 0) kill_after(folder, {"run"}, some(60));
  }
  return killed;
}

}  // namespace

int run_random_campaign(unsigned seed) {
  std::mt19937 random(seed);
  const std::string grid = random_grid(random);
  CAPTURE(seed);
  CAPTURE(grid);
  const std::string expected = undisturbed_rows(grid);
  const Folder folder;
  plan(folder, grid);
  const int killed = run_random_campaign(folder, random);
  CHECK(rows(folder) == expected);
  CHECK(campaign(folder, {"run"}).exit_code == 0);
  CHECK(campaign(folder, {"verify"}).exit_code == 0);
  return killed;
}

void check_completed(const Folder& folder, const std::string& expected) {
  CAPTURE(logs(folder));
  CHECK(number(folder, "SELECT count(*) FROM jobs WHERE status <> 'done'") == 0);
  CHECK(rows(folder) == expected);
  CHECK(campaign(folder, {"verify"}).exit_code == 0);
}

std::string computed_twice(const Folder& folder) {
  struct Stretch {
    double from, to;
  };
  constexpr double end_of_job = std::numeric_limits<double>::max();
  std::map<std::string, std::vector<Stretch>> stored;  // by the description of a job
  for (const auto& entry : std::filesystem::directory_iterator(folder / "shards")) {
    const std::string name = entry.path().filename().string();
    if (name.find("-task-") == std::string::npos) continue;
    std::map<std::string, double> begun;
    std::ifstream log(entry.path());
    for (std::string line; std::getline(log, line);) {
      // 12:00:00 info job 7 (cooling e=0.9 ...) goes on from tau = 20
      const auto from = line.find("(cooling "), to = line.rfind(") ");
      if (from == std::string::npos || to == std::string::npos) continue;
      const std::string job = line.substr(from, to - from), what = line.substr(to + 2);
      const double tau = what.find("tau = ") == std::string::npos
                             ? end_of_job
                             : std::stod(what.substr(what.find("tau = ") + 6));
      if (what.starts_with("goes on"))
        begun[job] = tau;
      else if (what.starts_with("is left") || what == "done")
        stored[job].push_back({std::exchange(begun[job], 0), tau});
    }
  }
  std::ostringstream twice;
  for (auto& [job, stretches] : stored) {
    std::ranges::sort(stretches, {}, &Stretch::from);
    double reached = 0;
    for (const Stretch& each : stretches) {
      const double end = std::min(each.to, reached);
      if (end > each.from) twice << job << ": tau = " << each.from << " to " << end << '\n';
      reached = std::max(reached, each.to);
    }
  }
  return twice.str();
}

}  // namespace haff::tests
