// SPDX-License-Identifier: GPL-3.0-or-later

// Large shards and large numbers of shards: memory stays constant, and time grows with the number
// of jobs. Also more random campaigns than tests/cli/cluster/shards.cpp has time for.
#include <doctest/doctest.h>

#include <chrono>

#include "support/divided_campaign.hpp"

using namespace haff::tests;

namespace {

using Clock = std::chrono::steady_clock;

Outcome done(const Folder& folder, std::vector<std::string> words) {
  Outcome outcome = campaign(folder, std::move(words));
  REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
  return outcome;
}

}  // namespace

TEST_CASE(
    "shards: random campaigns, divided, killed and merged at random, are the same in every bit") {
  int killed = 0;
  for (unsigned seed = 101; seed <= 125; ++seed) {
    CAPTURE(seed);
    killed += run_random_campaign(seed);
  }
  MESSAGE(killed << " merges were killed at work");
  CHECK(killed >= 100);
}

TEST_CASE("shards: with a million particles, no more than one state is held in memory") {
  const Folder folder;
  plan(folder, R"({"e": 0.9, "n": 0.3, "N": 1000000, "seeds": 2, "tau_max": 1, "equilibrate": 10,
    "checkpoint_every": 1, "observables": ["temperature"]})");
  done(folder, {"run", "--workers", "2", "--max-time", "8m"});
  // The store has four states of some 57 MB each; a longer tau_max lends them out.
  plan(folder, R"({"e": 0.9, "n": 0.3, "N": 1000000, "seeds": 2, "tau_max": 2, "equilibrate": 10,
    "checkpoint_every": 1, "observables": ["temperature"]})");
  const double state = number(folder, "SELECT max(bytes) FROM checkpoints");
  CHECK(number(folder, "SELECT count(*) FROM checkpoints") >= 2);
  const Outcome split = done(folder, {"split", "--into", "1"});
  done(folder, {"run", "--store", "shards/shard-001.db", "--workers", "1"});
  const Outcome merge = done(folder, {"merge", "shards/shard-001.db"});
  MESSAGE("a state has " << state / 1e6 << " MB; split took " << split.peak_bytes / 1e6
                         << " MB of memory, merge " << merge.peak_bytes / 1e6);
  // The program itself takes 20 MB, and states are copied piece by piece.
  CHECK(split.peak_bytes < 1.5 * state + 40e6);
  CHECK(merge.peak_bytes < 1.5 * state + 40e6);
}

TEST_CASE("shards: 30 000 jobs are split and merged in seconds per thousand, in constant memory") {
  const auto measure = [](int seeds) {
    const Folder folder;
    std::string e;
    for (int k = 0; k < 100; ++k) e += (k == 0 ? "" : ", ") + std::to_string(0.5 + 0.004 * k);
    plan(folder, R"({"e": [)" + e + R"(], "n": 0.3, "N": 64, "seeds": )" + std::to_string(seeds) +
                     R"(, "tau_max": 5, "equilibrate": 10,
                     "observables": ["temperature"]})");
    const double jobs = number(folder, "SELECT count(*) FROM jobs");
    const auto start = Clock::now();
    const Outcome split = done(folder, {"split", "--into", "4"});
    const auto lent = Clock::now();
    campaign(folder, {"run", "--store", "shards/shard-001.db", "--max-time", "20s"});
    const auto run = Clock::now();
    const Outcome merge = done(folder, {"merge", "shards/shard-001.db", "shards/shard-002.db",
                                        "shards/shard-003.db", "shards/shard-004.db"});
    const std::chrono::duration<double> splitting = lent - start, merging = Clock::now() - run;
    MESSAGE(jobs << " jobs: split in " << splitting.count() << " s and " << split.peak_bytes / 1e6
                 << " MB, merged in " << merging.count() << " s and " << merge.peak_bytes / 1e6
                 << " MB");
    CHECK(splitting.count() < 3 * jobs / 1000);
    CHECK(merging.count() < 3 * jobs / 1000);
    return std::max(split.peak_bytes, merge.peak_bytes) / jobs;
  };
  const double few = measure(30) * 3000, many = measure(300) * 30000;
  // The whole table of jobs is held in memory: some hundred bytes per job.
  CHECK(many < few + 50e6);
}
