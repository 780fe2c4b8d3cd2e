// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/run/process.hpp"

#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>

#include "campaign/run/abandoned.hpp"

using namespace haff;
using namespace haff::campaign;

TEST_CASE("process: this process lives") {
  CHECK(life_of(this_process()) == Life::alive);
}

TEST_CASE("process: another process with the same number is not the same process") {
  auto process = this_process();
  process.started -= 1;
  CHECK(life_of(process) == Life::dead);
}

TEST_CASE("process: a process from before a restart is dead") {
  auto process = this_process();
  process.boot_id[0] = process.boot_id[0] == '0' ? '1' : '0';
  CHECK(life_of(process) == Life::dead);
}

TEST_CASE("process: nothing is known of another host or container") {
  auto process = this_process();
  process.host += "-other";
  CHECK(life_of(process) == Life::unknown);
  process = this_process();
  process.boot_id += "other";
  CHECK(life_of(process) == Life::unknown);
}

TEST_CASE("process: a child that has ended is dead, reaped or not") {
  const pid_t id = fork();
  if (id == 0) {
    pause();
    _exit(0);
  }
  const schema::Owner child = child_process(id);
  CHECK(life_of(child) == Life::alive);
  kill(id, SIGKILL);
  siginfo_t info{};
  waitid(P_PID, static_cast<id_t>(id), &info, WEXITED | WNOWAIT);
  CHECK(life_of(child) == Life::dead);
  waitpid(id, nullptr, 0);
  CHECK(life_of(child) == Life::dead);
}

TEST_CASE("abandoned: a job of another host whose lease was not renewed for five minutes") {
  schema::RunningJob job;
  job.owner = this_process();
  job.owner.host += "-other";
  // The clock of the other host may be years behind or ahead.
  for (const char* renewed : {"2003-09-05T12:00:00.000Z", "2999-09-05T12:00:00.000Z"}) {
    job.renewed = renewed;
    LeaseWatch watch;
    const LeaseWatch::Clock::time_point start;
    CHECK_FALSE(watch.is_abandoned(job, start));
    CHECK_FALSE(watch.is_abandoned(job, start + std::chrono::seconds(300)));
    CHECK(watch.is_abandoned(job, start + std::chrono::seconds(301)));
  }
}

TEST_CASE(
    "abandoned: the five minutes begin anew when a lease is renewed or passes to another worker") {
  schema::RunningJob job;
  job.owner = this_process();
  job.owner.host += "-other";
  job.renewed = "2003-09-05T12:00:00.000Z";
  LeaseWatch watch;
  const LeaseWatch::Clock::time_point start;
  const auto step = lease_time - std::chrono::seconds(1);
  CHECK_FALSE(watch.is_abandoned(job, start));
  job.renewed = "2003-09-05T12:00:05.000Z";
  CHECK_FALSE(watch.is_abandoned(job, start + step));
  CHECK_FALSE(watch.is_abandoned(job, start + 2 * step - std::chrono::seconds(1)));
  job.lease.token = 1;
  CHECK_FALSE(watch.is_abandoned(job, start + 2 * step));
  CHECK_FALSE(watch.is_abandoned(job, start + 3 * step));
  CHECK(watch.is_abandoned(job, start + 4 * step));
}

TEST_CASE("abandoned: not a job of a living process, however old its lease") {
  schema::RunningJob job;
  job.owner = this_process();
  job.renewed = "2003-09-05T12:00:00.000Z";
  LeaseWatch watch;
  const LeaseWatch::Clock::time_point start;
  CHECK_FALSE(watch.is_abandoned(job, start));
  CHECK_FALSE(watch.is_abandoned(job, start + 10 * lease_time));
}
