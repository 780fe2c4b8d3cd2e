// Planning, claiming, committing: every change of a job, and who may make it.
#include "schema/store/store.hpp"

#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <set>
#include <stdexcept>
#include <thread>

#include "schema/database/database.hpp"
#include "schema/fixture.hpp"

using namespace haff::schema;

namespace {

// A store whose equilibrations are done, with one cooling job claimed.
struct Working {
  Store store;
  Claim claim;

  explicit Working(Store made = Store::in_memory(), double tau_max = 90)
      : store(std::move(made)), claim(start(store, tau_max)) {}

  static Claim start(Store& store, double tau_max) {
    store.add(plan({cooling()}, tau_max));
    equilibrate(store);
    return *store.claim(me, "test");
  }

  JobRow row() const { return store.job(claim.lease.job_id); }
};

Sample sample_at(double tau, double temperature = 0.5) {
  return {.tau = tau, .time = 2 * tau, .temperature = temperature};
}

}  // namespace

// ---- planning ---------------------------------------------------------------------------------

TEST_CASE("a planned job is in the store with all its physics") {
  Store store = Store::in_memory();
  Job job = cooling();
  job.sample_every = 0.5;
  job.seed = 9007199254740991;
  CHECK(store.add(plan({job})) == std::vector{Outcome::added, Outcome::added});
  const auto rows = store.jobs();
  REQUIRE(rows.size() == 2);
  CHECK(rows[0].job.kind == Kind::equilibration);
  CHECK_FALSE(rows[0].equilibration_id);
  CHECK(identity(rows[1].job) == identity(job));
  CHECK(rows[1].equilibration_id == rows[0].job_id);
  CHECK(rows[1].tau_max == 90);
  CHECK(rows[1].checkpoint_every == 10);
  CHECK(rows[1].status == Status::pending);
  CHECK(rows[1].created.size() == std::string("2003-09-05T12:00:00.000Z").size());
  CHECK_FALSE(rows[1].started);
  CHECK(store.find(job) == rows[1].job_id);
  CHECK_FALSE(store.find(cooling(0.5)));
}

TEST_CASE("a second plan adds nothing, a larger one the difference") {
  Store store = Store::in_memory();
  store.add(plan({cooling(0.8)}));
  CHECK(store.add(plan({cooling(0.8)})) == std::vector{Outcome::unchanged, Outcome::unchanged});
  const auto larger = plan({cooling(0.8), cooling(0.9)});
  CHECK(store.preview(larger) ==
        std::vector{Outcome::unchanged, Outcome::unchanged, Outcome::added});
  CHECK(store.jobs().size() == 2);
  CHECK(store.add(larger) == std::vector{Outcome::unchanged, Outcome::unchanged, Outcome::added});
  CHECK(store.jobs().size() == 3);
}

TEST_CASE("tau_max grows and never shrinks") {
  Store store = Store::in_memory();
  store.add(plan({cooling()}, 90));
  CHECK(store.preview(plan({cooling()}, 120))[1] == Outcome::extended);
  CHECK(store.add(plan({cooling()}, 120))[1] == Outcome::extended);
  CHECK(store.add(plan({cooling()}, 60))[1] == Outcome::unchanged);
  CHECK(store.jobs()[1].tau_max == 120);
}

TEST_CASE("a larger tau_max reopens a finished job at its checkpoint") {
  Working working;
  working.store.commit(working.claim.lease,
                       {.checkpoint = Checkpoint{.tau = 80, .collisions = 40000}});
  CHECK(working.store.finish(working.claim.lease, {.progress = {.tau = 90}}, Results{}, 90) ==
        Status::done);
  CHECK(working.row().finished);
  working.store.add(plan({cooling()}, 120));
  CHECK(working.row().status == Status::pending);
  CHECK_FALSE(working.row().finished);
  CHECK(working.store.checkpoint(working.claim.lease.job_id)->tau == 80);
  CHECK(working.store.claim(me, "test")->tau_max == 120);
}

TEST_CASE("a job extended while it runs is pending when its worker is done with the old length") {
  Working working;
  working.store.add(plan({cooling()}, 120));
  CHECK(working.row().status == Status::running);
  CHECK(complete(working.store, working.claim) == Status::pending);
  CHECK(complete(working.store, *working.store.claim(me, "test")) == Status::done);
}

TEST_CASE("a plan that fails adds nothing") {
  Store store = Store::in_memory();
  auto without_start = plan({cooling(0.8, 1), cooling(0.8, 2)});
  without_start.erase(without_start.begin() + 2);
  CHECK_THROWS_AS(store.add(without_start), std::logic_error);
  CHECK(store.jobs().empty());
}

TEST_CASE("jobs are listed by kind, physics and seed, however they were planned") {
  Store store = Store::in_memory();
  store.add(plan({cooling(0.9, 2), cooling(0.8, 10), cooling(0.9, 1), cooling(0.8, 9)}));
  std::vector<std::pair<std::optional<double>, std::uint64_t>> order;
  for (const JobRow& row : store.jobs()) order.emplace_back(row.job.e, row.job.seed);
  CHECK(order == std::vector<std::pair<std::optional<double>, std::uint64_t>>{
                     {1, 1}, {1, 2}, {1, 9}, {1, 10}, {0.8, 9}, {0.8, 10}, {0.9, 1}, {0.9, 2}});
}

TEST_CASE("a target that is planned again changes its error, not its pilot runs") {
  Store store = Store::in_memory();
  Target target{.series = series_identity(cooling()),
                .quantity = "a2",
                .tau_from = 5,
                .tau_to = 15,
                .se = 1e-3,
                .pilots = {1, 2, 3, 4, 5}};
  store.add(std::vector{target});
  target.se = 5e-4;
  target.pilots = {6, 7, 8, 9, 10};
  store.add(std::vector{target});
  const auto targets = store.targets();
  REQUIRE(targets.size() == 1);
  CHECK(targets[0].series == target.series);
  CHECK(targets[0].se == 5e-4);
  CHECK(targets[0].pilots == std::vector<std::uint64_t>{1, 2, 3, 4, 5});
}

TEST_CASE("what was expected of a target first is kept, for each standard error") {
  Store store = Store::in_memory();
  Target target{
      .series = series_identity(cooling()), .quantity = "a2", .se = 1e-3, .pilots = {1, 2, 3}};
  store.add(std::vector{target});
  CHECK_FALSE(store.targets()[0].prediction);
  store.predict(target, {.realizations = 20, .cpu_seconds = 3.5});
  store.predict(target, {.realizations = 30, .cpu_seconds = 4.5});
  REQUIRE(store.targets()[0].prediction);
  CHECK(store.targets()[0].prediction->realizations == 20);
  CHECK(store.targets()[0].prediction->cpu_seconds == 3.5);
  target.se = 5e-4;
  store.add(std::vector{target});
  CHECK_FALSE(store.targets()[0].prediction);
}

TEST_CASE("a prediction stands beside its outcome") {
  Store store = Store::in_memory();
  auto jobs = plan({cooling(0.8, 1), cooling(0.8, 2), cooling(0.9, 1)});
  store.add(jobs);
  const Target target{
      .series = series_identity(cooling(0.8)), .quantity = "a2", .se = 1e-3, .pilots = {1, 2}};
  store.add(std::vector{target});
  store.predict(target, {.realizations = 2, .cpu_seconds = 9});
  while (const auto claim = store.claim(me, "test"))
    store.finish(claim->lease,
                 {.checkpoint = Checkpoint{.tau = claim->tau_max},
                  .progress = {.tau = claim->tau_max, .cpu_seconds = 2}},
                 claim->job.kind == Kind::cooling ? std::optional(Results{}) : std::nullopt,
                 claim->tau_max);
  auto rows = store.query(
      "SELECT predicted_realizations, realizations, predicted_cpu_seconds, cpu_seconds "
      "FROM target_outcomes");
  const auto row = rows.next();
  REQUIRE(row);
  CHECK(*row == Row{std::int64_t{2}, std::int64_t{2}, 9.0, 8.0});
}

// ---- claiming ---------------------------------------------------------------------------------

TEST_CASE("equilibrations come first, cooling when its own is done") {
  Store store = Store::in_memory();
  store.add(plan({cooling(0.8, 1), cooling(0.8, 2)}));
  const auto one = store.claim(me, "test"), other = store.claim(me, "test");
  REQUIRE(one);
  REQUIRE(other);
  CHECK(one->job.kind == Kind::equilibration);
  CHECK(other->job.kind == Kind::equilibration);
  CHECK_FALSE(store.claim(me, "test"));
  CHECK(store.summary().waiting == 2);
  complete(store, *other);
  CHECK(store.summary().claimable == 1);
  const auto next = store.claim(me, "test");
  REQUIRE(next);
  CHECK(next->job.kind == Kind::cooling);
  CHECK(next->equilibration_id == other->lease.job_id);
}

TEST_CASE("a failed equilibration blocks the jobs that need it, until it is retried") {
  Store store = Store::in_memory();
  store.add(plan({cooling(0.8), cooling(0.9)}));
  for (int i = 0; i < max_attempts; ++i) store.fail(store.claim(me, "test")->lease, "jammed");
  CHECK_FALSE(store.claim(me, "test"));
  CHECK(store.summary().blocked == 2);
  CHECK(store.retry_failed() == 1);
  CHECK(store.summary().blocked == 0);
  CHECK(store.summary().waiting == 2);
  CHECK(store.claim(me, "test")->attempts == 0);
}

TEST_CASE("a job is computed again from its start unless a worker holds it") {
  Store store = Store::in_memory();
  store.add(plan({cooling(0.8)}));
  const auto claim = store.claim(me, "test");
  REQUIRE(claim);
  const std::int64_t id = claim->lease.job_id;
  CHECK_FALSE(store.restart(id));
  complete(store, *claim);
  REQUIRE(store.checkpoint(id));
  CHECK(store.restart(id));
  // The old state stays, unused, until a new one takes its place.
  REQUIRE(store.checkpoint(id));
  CHECK(store.job(id).starts_over);
  const auto again = store.claim(me, "test");
  REQUIRE(again);
  CHECK(again->lease.job_id == id);
  CHECK(again->starts_over);
  store.release(again->lease);
  CHECK(store.job(id).starts_over);
  CHECK(store.job(id).progress.tau == 0);
  complete(store, *store.claim(me, "test"));
  CHECK(store.checkpoint(id));
  CHECK_FALSE(store.job(id).starts_over);
}

TEST_CASE("a job that ends from its start without a new state leaves no damaged one behind") {
  Store store = Store::in_memory();
  store.add(plan({cooling(0.8)}));
  equilibrate(store);
  const Claim claim = *store.claim(me, "test");
  complete(store, claim, {}, Results{});
  CHECK(store.restart(claim.lease.job_id));
  const Claim again = *store.claim(me, "test");
  store.finish(again.lease, {.progress = {.tau = again.tau_max}}, Results{}, again.tau_max);
  CHECK_FALSE(store.checkpoint(claim.lease.job_id));
  CHECK_FALSE(store.job(claim.lease.job_id).starts_over);
}

TEST_CASE("the series of a job is its identity with the seed 0, in SQL as in code") {
  Store store = Store::in_memory();
  Job disks = cooling(0.85, 7);
  disks.d = 2;
  disks.effects = R"({"shuffle":{"every":0.1}})";
  disks.profiles_every = 1e-3;
  store.add(plan({cooling(0.1, 12345678901), disks}));
  for (const JobRow& row : store.jobs()) CHECK(row.series == series_identity(row.job));
}

TEST_CASE("what takes longest is claimed first") {
  Store store = Store::in_memory();
  auto jobs = plan({cooling(0.7), cooling(0.8), cooling(0.9)});
  jobs[1].expected_cpu_seconds = 10;
  jobs[2].expected_cpu_seconds = 30;
  jobs[3].expected_cpu_seconds = 20;
  store.add(jobs);
  equilibrate(store);
  for (const double e : {0.8, 0.9, 0.7}) CHECK(store.claim(me, "test")->job.e == e);
}

TEST_CASE("a claim tells where the job stands and marks who holds it") {
  Store store = Store::in_memory();
  auto jobs = plan({cooling()});
  jobs[1].checkpoint_every = 20;
  store.add(jobs);
  equilibrate(store);
  const auto claim = store.claim(another, "version 2");
  REQUIRE(claim);
  CHECK(identity(claim->job) == identity(cooling()));
  CHECK(claim->tau_max == 90);
  CHECK(claim->checkpoint_every == 20);
  const auto running = store.running();
  REQUIRE(running.size() == 1);
  CHECK(running[0].owner == another);
  CHECK(running[0].lease.token == claim->lease.token);
  CHECK(running[0].tau_max == 90);
  CHECK_FALSE(running[0].renewed.empty());
  const JobRow row = store.job(claim->lease.job_id);
  CHECK(row.code_version == "version 2");
  CHECK(row.host == "here");
  CHECK(row.started);
}

TEST_CASE("many connections never claim a job twice") {
  const TemporaryFolder folder;
  std::vector<Job> jobs;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) jobs.push_back(cooling(0.8, seed));
  Store::create(folder / "a.db").add(plan(jobs));

  std::atomic<int> claims = 0;
  {
    std::vector<std::jthread> workers;
    workers.reserve(4);
    for (int i = 0; i < 4; ++i)
      workers.emplace_back([&] {
        Store store = Store::open(folder / "a.db");
        while (store.summary().jobs[Status::done] < 80)
          if (const auto claim = store.claim(me, "test")) {
            ++claims;
            complete(store, *claim);
          }
      });
  }
  CHECK(claims == 80);
  CHECK(Reader(folder / "a.db").summary().jobs[Status::done] == 80);
}

// ---- the lease --------------------------------------------------------------------------------

TEST_CASE("a writer whose lease has passed to another is refused and changes nothing") {
  Working old;
  REQUIRE(old.store.reclaim(old.claim.lease));
  const auto next = old.store.claim(another, "test");
  REQUIRE(next);
  CHECK(next->lease.job_id == old.claim.lease.job_id);

  const Commit late{
      .samples = {sample_at(0)}, .checkpoint = Checkpoint{.tau = 10}, .progress = {.tau = 10}};
  CHECK_THROWS_AS(old.store.commit(old.claim.lease, late), LeaseLost);
  CHECK_THROWS_AS(old.store.progress(old.claim.lease, {.tau = 5}), LeaseLost);
  CHECK_THROWS_AS(old.store.finish(old.claim.lease, late, Results{}, 90), LeaseLost);
  CHECK_THROWS_AS(old.store.fail(old.claim.lease, "late"), LeaseLost);
  CHECK_THROWS_AS(old.store.release(old.claim.lease), LeaseLost);
  CHECK_FALSE(old.store.reclaim(old.claim.lease));

  CHECK(old.row().status == Status::running);
  CHECK(old.row().progress.tau == 0);
  CHECK_FALSE(old.row().error);
  CHECK(old.store.samples(next->lease.job_id).empty());
  CHECK_FALSE(old.store.checkpoint(next->lease.job_id));
  old.store.commit(next->lease, late);
}

TEST_CASE("a lease that was released is lost, although no other worker took the job") {
  Working working;
  working.store.release(working.claim.lease);
  CHECK_THROWS_AS(working.store.commit(working.claim.lease, {}), LeaseLost);
  CHECK_THROWS_AS(working.store.release(working.claim.lease), LeaseLost);
}

TEST_CASE("release and reclaim put a job back to its checkpoint and cost no attempt") {
  for (const bool dead : {false, true}) {
    Working working;
    const Lease lease = working.claim.lease;
    working.store.commit(lease, {.checkpoint = Checkpoint{.tau = 10, .collisions = 5000},
                                 .progress = {.tau = 10, .collisions = 5000, .cpu_seconds = 3}});
    working.store.progress(lease, {.tau = 17, .collisions = 8500, .cpu_seconds = 5});
    CHECK(working.row().progress.tau == 17);
    if (dead)
      CHECK(working.store.reclaim(lease));
    else
      working.store.release(lease);
    CHECK(working.row().status == Status::pending);
    CHECK(working.row().progress.tau == 10);
    CHECK(working.row().progress.collisions == 5000);
    CHECK(working.row().progress.cpu_seconds == 5);  // spent is spent
    CHECK(working.row().attempts == 0);
    CHECK(working.store.running().empty());
    CHECK(working.store.claim(me, "test")->cpu_seconds == 5);
  }
}

// ---- committing -------------------------------------------------------------------------------

TEST_CASE("a commit is read back to the last bit") {
  Working working;
  const Sample first{.tau = 0, .time = 0, .temperature = 2.0 / 3};
  const Sample second{.tau = 1,
                      .time = 0.1 + 0.2,
                      .temperature = 1e-60 / 3,
                      .gamma_ratio = 0.97,
                      .collision_rate = 4.1,
                      .pressure = 1.3,
                      .a2 = -0.01,
                      .a3 = -5e-324,
                      .a4 = 1.7976931348623157e308,
                      .a5 = 1e-17,
                      .a6 = 0.0};
  working.store.commit(working.claim.lease, {.samples = {first, second}});
  CHECK(working.store.samples(working.claim.lease.job_id) == std::vector{first, second});
}

TEST_CASE("the last sample before a checkpoint is found") {
  Working working;
  const auto job_id = working.claim.lease.job_id;
  CHECK_FALSE(working.store.last_sample(job_id, 90));
  working.store.commit(working.claim.lease,
                       {.samples = {sample_at(0), sample_at(1), sample_at(2)}});
  CHECK(working.store.last_sample(job_id, 1.5) == sample_at(1));
  CHECK(working.store.last_sample(job_id, 2) == sample_at(2));
  CHECK(working.store.last_sample(job_id, 90) == sample_at(2));
}

TEST_CASE("samples that are there already are kept, and must agree") {
  Working working;
  const Lease lease = working.claim.lease;
  Sample sample = sample_at(1);
  sample.gamma_ratio = 1.0;
  working.store.commit(lease, {.samples = {sample}});

  Sample again = sample;
  again.gamma_ratio = std::nextafter(1.0, 2.0);  // another C library's logarithm
  working.store.commit(lease, {.samples = {again}});
  CHECK(working.store.samples(lease.job_id) == std::vector{sample});

  again.temperature = std::nextafter(0.5, 1.0);
  CHECK_THROWS_AS(working.store.commit(lease, {.samples = {sample_at(2), again}}), Damage);
  CHECK(working.store.samples(lease.job_id) == std::vector{sample});
}

TEST_CASE("a sample that is not finite is refused with all it came with") {
  Working working;
  const Lease lease = working.claim.lease;
  for (const double broken : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    Sample sample = sample_at(1);
    sample.a2 = broken;
    const Commit commit{.samples = {sample_at(0), sample}, .checkpoint = Checkpoint{.tau = 10}};
    CHECK_THROWS_AS(working.store.commit(lease, commit), Damage);
  }
  CHECK(working.store.samples(lease.job_id).empty());
  CHECK_FALSE(working.store.checkpoint(lease.job_id));
}

TEST_CASE("finishing stores the results and ends the lease") {
  Working working;
  const Lease lease = working.claim.lease;
  const Results results{.tau_c = 58.5, .time_c = 100.25};
  CHECK(complete(working.store, working.claim, {sample_at(0)}, results) == Status::done);
  CHECK(working.store.results(lease.job_id) == results);
  CHECK(working.row().status == Status::done);
  CHECK(working.row().finished);
  CHECK(working.row().progress.tau == 90);
  CHECK(working.store.running().empty());
  CHECK_THROWS_AS(working.store.commit(lease, {}), LeaseLost);
}

TEST_CASE("a result that was not reached is NULL, and no row is no result") {
  Working working;
  CHECK_FALSE(working.store.results(working.claim.lease.job_id));
  complete(working.store, working.claim, {}, Results{});
  CHECK(working.store.results(working.claim.lease.job_id) == Results{});
}

// ---- failing ----------------------------------------------------------------------------------

TEST_CASE("a job is retried until its attempts are used up") {
  Working working;
  Claim claim = working.claim;
  for (int attempt = 1; attempt < max_attempts; ++attempt) {
    CHECK(working.store.fail(claim.lease, "overlap") == Status::pending);
    claim = *working.store.claim(me, "test");
    CHECK(claim.attempts == attempt);
  }
  CHECK(working.store.fail(claim.lease, "overlap of 3 and 5") == Status::failed);
  CHECK(working.row().status == Status::failed);
  CHECK(working.row().error == "overlap of 3 and 5");
  CHECK(working.row().finished);
  CHECK_FALSE(working.store.claim(me, "test"));
  CHECK(working.store.retry_failed() == 1);
  CHECK(working.store.retry_failed() == 0);
  claim = *working.store.claim(me, "test");
  CHECK(claim.attempts == 0);
  complete(working.store, claim);
  CHECK_FALSE(working.row().error);
}

TEST_CASE("a new checkpoint gives a job all its attempts back") {
  Working working;
  working.store.fail(working.claim.lease, "killed");
  const Claim claim = *working.store.claim(me, "test");
  working.store.commit(claim.lease, {.checkpoint = Checkpoint{.tau = 10}});
  working.store.fail(claim.lease, "killed");
  CHECK(working.store.claim(me, "test")->attempts == 1);
}

TEST_CASE("a summary counts jobs and time") {
  Store store = Store::in_memory();
  auto jobs = plan({cooling(0.8), cooling(0.9)});
  for (Planned& planned : jobs) planned.expected_cpu_seconds = 100;
  store.add(jobs);
  equilibrate(store);
  const Claim claim = *store.claim(me, "test");
  store.progress(claim.lease, {.tau = 45, .cpu_seconds = 60});
  Summary summary = store.summary();
  CHECK(summary.jobs[Status::done] == 1);
  CHECK(summary.jobs[Status::running] == 1);
  CHECK(summary.jobs[Status::pending] == 1);
  CHECK(summary.jobs[Status::failed] == 0);
  CHECK(summary.jobs.size() == statuses.size());
  CHECK(summary.claimable == 1);
  CHECK(summary.cpu_seconds == 60);
  CHECK(summary.expected_cpu_seconds == 300);
  CHECK(summary.remaining_cpu_seconds == 150);
}

// ---- crashes and the disk ---------------------------------------------------------------------

TEST_CASE("a writer killed at any moment leaves samples and checkpoint of one commit") {
  const TemporaryFolder folder;
  const auto path = folder / "a.db";
  Store::create(path).add(plan({cooling()}));
  const auto state = bytes(200'000);
  for (unsigned kill_after = 0; kill_after < 20; ++kill_after) {
    const pid_t child = fork();
    if (child == 0) {
      Store store = Store::open(path);
      const Claim claim = *store.claim(me, "test");
      const auto last = store.checkpoint(claim.lease.job_id);
      for (double tau = last ? last->tau + 1 : 0;; ++tau)
        store.commit(claim.lease, {.samples = {sample_at(tau)},
                                   .checkpoint = Checkpoint{.tau = tau, .state = state}});
    }
    // The later ones are killed some time after a commit, however slow the machine is.
    if (kill_after >= 10) {
      const auto before = Reader(path).last_sample(1, 1e9);
      const auto begin = std::chrono::steady_clock::now();
      const auto has_committed = [&] {
        const auto now = Reader(path).last_sample(1, 1e9);
        return now && (!before || now->tau > before->tau);
      };
      while (!has_committed() &&
             std::chrono::steady_clock::now() - begin < std::chrono::seconds(10))
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5 + 7 * (kill_after % 10)));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);

    Store store = Store::open(path);
    CHECK(store.faults().empty());
    for (const RunningJob& running : store.running()) CHECK(store.reclaim(running.lease));
    const auto checkpoint = store.checkpoint(1);
    const auto sample = store.last_sample(1, 1e9);
    REQUIRE(checkpoint.has_value() == sample.has_value());
    if (checkpoint) {
      CHECK(checkpoint->state == state);
      CHECK(checkpoint->tau == sample->tau);
      CHECK(store.samples(1).size() == static_cast<std::size_t>(sample->tau) + 1);
    }
  }
  CHECK(Reader(path).checkpoint(1));
}

TEST_CASE("a disk that takes no more undoes the commit, says so, and leaves the store sound") {
  const TemporaryFolder folder;
  Working working(Store::create(folder / "a.db"));
  const Lease lease = working.claim.lease;
  const Checkpoint first{.tau = 10, .collisions = 5000, .state = bytes(100'000)};
  working.store.commit(lease, {.samples = {sample_at(0)}, .checkpoint = first});

  // The kernel refuses to let any file of this process grow beyond 1 MB, as a full disk would.
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{.rlim_cur = 1'000'000, .rlim_max = before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const Commit large{.samples = {sample_at(1)},
                     .checkpoint = Checkpoint{.tau = 20, .state = bytes(3'000'000)}};
  CHECK_THROWS_AS(working.store.commit(lease, large), DiskError);
  setrlimit(RLIMIT_FSIZE, &before);

  CHECK(working.store.samples(lease.job_id) == std::vector{sample_at(0)});
  CHECK(working.store.checkpoint(lease.job_id)->state == first.state);
  CHECK(Reader(folder / "a.db").faults().empty());
  working.store.commit(lease, large);
  CHECK(working.store.checkpoint(lease.job_id)->tau == 20);
}

TEST_CASE("a gas without e is stored as it is, and averaged") {
  Store store = Store::in_memory();
  std::vector<Job> jobs{cooling(0.8, 1), cooling(0.8, 2)};
  for (Job& job : jobs) {
    job.e = std::nullopt;
    job.effects = R"({"restitution":{"A":0.1,"law":"viscoelastic"}})";
  }
  store.add(plan(jobs));
  equilibrate(store);
  for (const double temperature : {0.5, 0.7}) {
    const auto claim = store.claim(me, "test");
    CHECK_FALSE(claim->job.e);
    complete(store, *claim, {{.tau = 0, .temperature = temperature}}, Results{});
  }
  auto rows = store.query(
      "SELECT mean_series.e, temperature, gamma_ratio, tau_c FROM mean_series JOIN mean_tau_c "
      "USING (effects)");
  const auto row = rows.next().value();
  CHECK(std::holds_alternative<std::monostate>(row[0]));
  CHECK(std::get<double>(row[1]) == doctest::Approx(0.6));
  CHECK(std::holds_alternative<std::monostate>(row[2]));
  CHECK(std::holds_alternative<std::monostate>(row[3]));
  auto found = store.query(
      "SELECT count(*) FROM job_effects WHERE effect = 'restitution' AND value = 'viscoelastic'");
  CHECK(std::get<std::int64_t>(found.next().value()[0]) == 2);
}
