// SPDX-License-Identifier: GPL-3.0-or-later

// The work that a stop keeps, and the cost of a kill.
#include <doctest/doctest.h>

#include <csignal>

#include "cli/program.hpp"

using namespace haff::tests;
using namespace std::chrono_literals;

namespace {

void plan(const Folder& folder, const std::string& grid) {
  folder.write("grid.json", grid);
  REQUIRE(campaign(folder, {"plan", "grid.json"}).exit_code == 0);
}

}  // namespace

TEST_CASE("stops: a stop near a synchronization keeps the work, also when no checkpoint is due") {
  const Folder folder;
  // The next synchronization is at most 200 000 collisions away, a fraction of a second and ten
  // stretches after each of which a worker checks whether it is to stop.
  plan(folder, R"({"e": 0.9, "n": 0.4, "N": 40000, "seeds": 1, "tau_max": 100000, "equilibrate": 10,
                   "sample_every": 100, "checkpoint_every": 100000})");
  Program run(folder, {"run", "--workers", "1"});
  while (number(folder,
                "SELECT count(*) FROM jobs WHERE kind = 'cooling' AND status = 'running'") == 0)
    sleep_for(5ms);
  sleep_for(500ms);
  run.signal(SIGTERM);
  CHECK(run.wait().exit_code == 128 + SIGTERM);
  CHECK(number(folder,
               "SELECT count(*) FROM checkpoints JOIN jobs USING (job_id) "
               "WHERE kind = 'cooling'") == 1);
  CHECK(number(folder, "SELECT max(tau_reached) FROM jobs WHERE kind = 'cooling'") > 0);
}

TEST_CASE("stops: ten kills in a row without progress are excused, three more fail the job") {
  const Folder folder;
  // Between two kills the first checkpoint, after three million collisions, is never reached.
  plan(folder, R"({"e": 0.9, "n": 0.4, "N": 600000, "seeds": 1, "tau_max": 10})");
  Program run(folder, {"run", "--workers", "1"});
  double owner = 0;
  const auto wait_for_another_owner = [&] {
    for (const double last = owner; run.runs() && (owner == last || owner == 0); sleep_for(2ms))
      owner =
          number(folder, "SELECT coalesce(max(owner_pid), 0) FROM jobs WHERE status = 'running'");
  };
  const auto attempts = [&] { return number(folder, "SELECT sum(attempts) FROM jobs"); };
  for (int kills = 0; kills < 13; ++kills) {
    CAPTURE(kills);
    wait_for_another_owner();
    REQUIRE(run.runs());
    CHECK(attempts() == (kills > 10 ? kills - 10 : 0));
    kill(static_cast<pid_t>(owner), SIGKILL);
  }
  run.wait();
  CHECK(attempts() == 3);
  CHECK(number(folder, "SELECT count(*) FROM jobs WHERE status = 'failed'") == 1);
}

TEST_CASE("stops: at a time limit the gas goes on to a synchronization, however long that takes") {
  const Folder folder;
  plan(folder,
       R"({"e": 0.9, "n": 0.4, "N": 400000, "seeds": 1, "equilibrate": 10, "tau_max": 20})");
  REQUIRE(campaign(folder, {"run", "--where", "kind = 'equilibration'"}).exit_code == 0);
  Program run(folder, {"run", "--workers", "1", "--budget", "0.5s"});
  while (number(folder, "SELECT count(*) FROM jobs WHERE status = 'running'") == 0) sleep_for(5ms);
  sleep_for(300ms);
  // The limit comes early in the first period, which takes a second or more. A worker that did not
  // run for six seconds expects the rest to take much longer than that, and would give up its work
  // if a signal asked it to stop.
  const pid_t worker = run.workers().at(0);
  kill(worker, SIGSTOP);
  sleep_for(6s);
  kill(worker, SIGCONT);
  CHECK(run.wait().exit_code == 3);
  CHECK(number(folder,
               "SELECT count(*) FROM checkpoints JOIN jobs USING (job_id) "
               "WHERE kind = 'cooling'") == 1);
}
