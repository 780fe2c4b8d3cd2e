// SPDX-License-Identifier: GPL-3.0-or-later

// Opening a store: which stores are made, brought forward and refused.
#include "schema/database/database.hpp"

#include <doctest/doctest.h>
#include <sys/stat.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>

#include "schema/embedded.hpp"
#include "schema/fixture.hpp"

using namespace haff::schema;

namespace {

std::string contents(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// The connection of another program, which uses plain SQLite.
SQLite::Database plain(const std::filesystem::path& path) {
  return {path.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE};
}

}  // namespace

TEST_CASE("a new store is marked as a store") {
  const TemporaryFolder folder;
  Store::create(folder / "a.db");
  SQLite::Database sqlite = plain(folder / "a.db");
  CHECK(sqlite.execAndGet("PRAGMA application_id").getInt() == application_id);
  CHECK(sqlite.execAndGet("PRAGMA user_version").getInt() == newest_version());
  CHECK(sqlite.execAndGet("PRAGMA journal_mode").getString() == "delete");  // no log at rest
}

TEST_CASE("every table is strict") {
  const TemporaryFolder folder;
  Store::create(folder / "a.db");
  SQLite::Database sqlite = plain(folder / "a.db");
  CHECK(sqlite
            .execAndGet("SELECT count(*) FROM pragma_table_list WHERE type = 'table' AND "
                        "name NOT LIKE 'sqlite_%' AND NOT strict")
            .getInt() == 0);
  CHECK(sqlite.execAndGet("SELECT count(*) FROM pragma_table_list WHERE strict").getInt() > 0);
}

TEST_CASE("the statuses of the store are those of the program, in order") {
  const Store store = Store::in_memory();
  Query rows = store.query("SELECT position, status, meaning FROM job_status ORDER BY position");
  for (const StatusEntry& entry : statuses)
    CHECK(rows.next() == Row{static_cast<std::int64_t>(entry.status), std::string(entry.name),
                             std::string(entry.meaning)});
  CHECK_FALSE(rows.next());
}

TEST_CASE("opening a store again keeps what is in it") {
  const TemporaryFolder folder;
  Store::create(folder / "a.db").add(plan({cooling()}));
  CHECK(Store::create(folder / "a.db").jobs().size() == 2);
  CHECK(Store::open(folder / "a.db").jobs().size() == 2);
  CHECK(Reader(folder / "a.db").jobs().size() == 2);
}

TEST_CASE("two processes may make a store at the same time") {
  const TemporaryFolder folder;
  for (int round = 0; round < 20; ++round) {
    const auto path = folder / ("a" + std::to_string(round));
    std::jthread one([&] { Store::create(path).add(plan({cooling(0.8)})); });
    std::jthread other([&] { Store::create(path).add(plan({cooling(0.9)})); });
    one.join();
    other.join();
    CHECK(Reader(path).jobs().size() == 3);
  }
}

TEST_CASE("a store that should exist is not made") {
  const TemporaryFolder folder;
  const auto path = folder / "a.db";
  const std::string message = path.string() + ": there is no such store";
  CHECK(refusal([&] { Store::open(path); }) == message);
  CHECK(refusal([&] { Reader{path}; }) == message);
  CHECK(error_of([&] { Reader{path}; }).remedy == Remedy::plan);
  CHECK(error_of([&] { Reader{path}; }).store == path);
  CHECK_FALSE(std::filesystem::exists(path));
}

TEST_CASE("a store in a folder that does not exist is refused") {
  const TemporaryFolder folder;
  const auto path = folder / "no/a.db";
  CHECK(refusal([&] { Store::create(path); }) == path.string() + ": its folder, " +
                                                     (folder / "no").string() +
                                                     ", is not there; make it first");
}

TEST_CASE("an empty file may become a store, but is not one yet") {
  const TemporaryFolder folder;
  const auto path = folder / "a.db";
  std::ofstream empty(path);
  CHECK(refusal([&] { Reader{path}; }).starts_with(path.string() + ": is empty"));
  Store::create(path);
  CHECK(Reader(path).jobs().empty());
}

TEST_CASE("a file that is not SQLite's is refused and left alone") {
  const TemporaryFolder folder;
  const auto path = folder / "a.db";
  std::ofstream(path) << std::string(5000, 'x');
  const std::string message = path.string() + ": is not an SQLite file";
  CHECK(refusal([&] { Store::create(path); }) == message);
  CHECK(refusal([&] { Reader{path}; }) == message);
  CHECK(contents(path) == std::string(5000, 'x'));
}

TEST_CASE("another program's SQLite file is refused and left alone") {
  const TemporaryFolder folder;
  const auto path = folder / "a.db";
  plain(path).exec("CREATE TABLE songs (title TEXT)");
  const std::string before = contents(path);
  const std::string message = path.string() + ": is the SQLite file of another program";
  CHECK(refusal([&] { Store::create(path); }) == message);
  CHECK(refusal([&] { Store::open(path); }) == message);
  CHECK(refusal([&] { Reader{path}; }) == message);
  CHECK(contents(path) == before);
}

TEST_CASE("a store of a newer program is refused") {
  const TemporaryFolder folder;
  const auto path = folder / "a.db";
  Store::create(path);
  const int known = plain(path).execAndGet("PRAGMA user_version").getInt();
  plain(path).exec("PRAGMA user_version = " + std::to_string(known + 1));
  const std::string message = path.string() + ": was written by a newer program (store version " +
                              std::to_string(known + 1) + ", this one knows " +
                              std::to_string(known) + "); update campaign";
  CHECK(refusal([&] { Store::create(path); }) == message);
  CHECK(refusal([&] { Store::open(path); }) == message);
  CHECK(refusal([&] { Reader{path}; }) == message);
}

TEST_CASE("migration runs the scripts that a store has not seen, once") {
  const TemporaryFolder folder;
  SQLite::Database sqlite = plain(folder / "a.db");
  const std::vector<std::string_view> scripts{"CREATE TABLE a (x); INSERT INTO a VALUES (1);",
                                              "ALTER TABLE a ADD COLUMN y DEFAULT 5;"};
  migrate(sqlite, "a.db", std::span(scripts).first(1));
  sqlite.exec("INSERT INTO a VALUES (2)");
  migrate(sqlite, "a.db", scripts);
  migrate(sqlite, "a.db", scripts);
  CHECK(sqlite.execAndGet("SELECT group_concat(x || '-' || y) FROM a").getString() == "1-5,2-5");
  CHECK(sqlite.execAndGet("PRAGMA user_version").getInt() == 2);
}

namespace {

// An identity as it is in stores up to version 7.
std::string with_precision(std::string identity) {
  return identity.insert(identity.find(R"(,"sample_every":)"), R"(,"precision":"double")");
}

}  // namespace

TEST_CASE("a store of the first version is read as it is, and brought forward when asked") {
  const TemporaryFolder folder;
  const auto path = folder / "a.db";
  const Job job = equilibration_of(cooling());
  {
    SQLite::Database sqlite = plain(path);
    migrate(sqlite, path, std::span(&embedded()[0].text, 1));
    REQUIRE(sqlite.execAndGet("PRAGMA user_version").getInt() == 1);
    sqlite.exec(R"(
      INSERT INTO jobs (identity, kind, d, e, n, particles, seed, equilibrate, sample_every,
                        precision, effects, observables, tau_max, checkpoint_every, created)
      VALUES (')" +
                with_precision(identity(job)) + R"(', 'equilibration', 3, 1, 0.4, 1000,
              1, 50, 10, 'double', '{}', '["laguerre","temperature"]', 50, 10, 'then');
      INSERT INTO samples VALUES (1, 0, 0, 0.5, NULL, NULL, NULL, 0.1, 0.1, 0.1, 0.1, 0.1))");
  }
  const std::string before = contents(path);
  {
    const Reader reader(path);
    CHECK(reader.find(job) == 1);
    REQUIRE(reader.samples(1).size() == 1);
    CHECK(reader.samples(1)[0].temperature == 0.5);
    CHECK_FALSE(reader.samples(1)[0].largest_cluster);
  }
  CHECK(contents(path) == before);
  CHECK_FALSE(std::filesystem::exists(folder / "a.db-wal"));
  const StoreError refused = error_of([&] { Store::open(path); });
  CHECK(std::string(refused.what())
            .find("is of an older version (1, this program's is " +
                  std::to_string(newest_version())) != std::string::npos);
  CHECK(refused.remedy == Remedy::upgrade);
  CHECK(contents(path) == before);

  CHECK(Store::upgrade(path, {}) == 1);
  Store store = Store::open(path);
  CHECK(store.find(job) == 1);
  REQUIRE(store.samples(1).size() == 1);
  CHECK(store.samples(1)[0].temperature == 0.5);
  CHECK(store.add(plan({cooling()})) == std::vector{Outcome::unchanged, Outcome::added});
}

TEST_CASE("a store that names a precision keeps its jobs and targets without it") {
  const TemporaryFolder folder;
  const auto path = folder / "a.db";
  const std::vector<Planned> jobs = plan({cooling(0.8, 1), cooling(0.8, 2)});
  const Target target{
      .series = series_identity(cooling()), .quantity = "tau_c", .se = 0.1, .pilots = {1, 2}};
  {
    SQLite::Database sqlite = plain(path);
    std::vector<std::string_view> scripts;
    for (const Embedded& file : embedded())
      if (file.name.ends_with(".sql") && file.name < "010") scripts.push_back(file.text);
    migrate(sqlite, path, scripts);
    for (const Planned& each : jobs) {
      SQLite::Statement insert(sqlite, R"(
        INSERT INTO jobs (identity, kind, d, e, n, particles, seed, equilibrate, sample_every,
                          precision, effects, observables, tau_max, checkpoint_every, created,
                          equilibration_id)
        VALUES (?1, ?2, 3, ?3, 0.4, 1000, ?4, 50, ?5, 'double', '{}',
                '["laguerre","temperature"]', ?6, 10, 'then',
                iif(?2 = 'cooling', (SELECT job_id FROM jobs WHERE kind = 'equilibration'
                                     AND seed = ?4), NULL)))");
      insert.bind(1, with_precision(identity(each.job)));
      insert.bind(2, std::string(name(each.job.kind)));
      insert.bind(3, *each.job.e);
      insert.bind(4, static_cast<std::int64_t>(each.job.seed));
      insert.bind(5, each.job.sample_every);
      insert.bind(6, each.tau_max);
      insert.exec();
    }
    const std::string series = with_precision(target.series);
    sqlite.exec("INSERT INTO targets VALUES ('" + series + "', 'tau_c', 0, 0, 0.1, '[1,2]')");
    sqlite.exec("INSERT INTO target_predictions VALUES ('" + series +
                "', 'tau_c', 0, 0, 0.1, 9, 5.5, 'then')");
  }
  CHECK(Store::upgrade(path, {}) == 7);
  Store store = Store::open(path);
  CHECK(store.add(jobs) == std::vector(4, Outcome::unchanged));
  store.add({target});
  const std::vector<Target> targets = store.targets();
  REQUIRE(targets.size() == 1);
  CHECK(targets[0].series == target.series);
  REQUIRE(targets[0].prediction);
  CHECK(targets[0].prediction->realizations == 9);
  CHECK(store.query("SELECT count(*) FROM mean_series").next());
  for (const char* none : {"SELECT 1 FROM pragma_table_info('jobs') WHERE name = 'precision'",
                           "SELECT 1 FROM pragma_foreign_key_check"})
    CHECK_FALSE(store.query(none).next());
}

TEST_CASE("a store is not brought forward while a worker holds a job") {
  const TemporaryFolder folder;
  const auto path = folder / "a.db";
  {
    SQLite::Database sqlite = plain(path);
    const auto all = scripts();
    migrate(sqlite, path, std::span(all).first(7));
    sqlite.exec(R"(
      INSERT INTO jobs (identity, kind, d, e, n, particles, seed, equilibrate, sample_every,
                        precision, effects, observables, tau_max, checkpoint_every, created,
                        status, lease, host, owner_boot_id, owner_pid, owner_started, renewed)
      VALUES ('one', 'equilibration', 3, 1, 0.4, 1000, 1, 50, 10, 'double', '{}', '[]', 50, 10,
              'then', 'running', 4, 'there', 'boot', 77, 1, 'now'))");
  }
  const std::string before = contents(path);
  CHECK(refusal([&] { Store::upgrade(path, {}); }) ==
        path.string() +
            ": job 1 is being run by process 77 on there, a program of the older version; upgrade "
            "when its run has ended");
  CHECK(contents(path) == before);
  CHECK(Store::upgrade(path, {{.job_id = 1, .token = 4}}) == 7);
  CHECK(Reader(path).summary().jobs.at(Status::pending) == 1);
}

TEST_CASE("a running program leaves a store alone that was brought forward meanwhile") {
  const TemporaryFolder folder;
  const auto path = folder / "a.db";
  Store store = Store::create(path);
  store.add(plan({cooling()}));
  plain(path).exec("PRAGMA user_version = " + std::to_string(newest_version() + 1));
  CHECK(refusal([&] { store.claim(me, "test"); }) ==
        path.string() + ": was brought forward to version " + std::to_string(newest_version() + 1) +
            " by a newer program while this one used it; update campaign");
}

TEST_CASE("a migration that fails changes nothing") {
  const TemporaryFolder folder;
  SQLite::Database sqlite = plain(folder / "a.db");
  const std::vector<std::string_view> scripts{"CREATE TABLE a (x);", "CREATE TABLE b (x); oops;"};
  migrate(sqlite, "a.db", std::span(scripts).first(1));
  CHECK_THROWS_AS(migrate(sqlite, "a.db", scripts), SQLite::Exception);
  CHECK(sqlite.execAndGet("PRAGMA user_version").getInt() == 1);
  CHECK_FALSE(sqlite.tableExists("b"));
}

TEST_CASE("SQLite refuses writes through a reader's connection") {
  const TemporaryFolder folder;
  Store::create(folder / "a.db").add(plan({cooling()}));
  Database reader(folder / "a.db", Access::read);
  for (const char* sql : {"DELETE FROM jobs", "CREATE TABLE t (x)", "PRAGMA user_version = 7",
                          "PRAGMA query_only = OFF; DELETE FROM jobs"}) {
    CAPTURE(sql);
    try {
      reader.sqlite().exec(sql);
      CHECK(std::string(sql).find("DELETE") == std::string::npos);
    } catch (const SQLite::Exception& error) {
      const std::string what = error.what();
      CHECK((what == "attempt to write a readonly database" || what == "not authorized"));
    }
  }
  CHECK(Reader(folder / "a.db").jobs().size() == 2);
  CHECK(reader.sqlite().execAndGet("PRAGMA user_version").getInt() == newest_version());
}

TEST_CASE("readers see a store that a killed writer left with its log, and leave the log there") {
  const TemporaryFolder folder;
  Store writer = Store::create(folder / "a.db");
  writer.open_log();
  writer.add(plan({cooling()}));
  // A crash leaves the log behind, not yet copied into the file.
  for (const char* suffix : {"", "-wal"})
    std::filesystem::copy_file((folder / "a.db").string() + suffix,
                               (folder / "b.db").string() + suffix);
  CHECK(Reader(folder / "b.db").jobs().size() == 2);
  CHECK_FALSE(Reader(folder / "b.db").lacks_log());
  CHECK(std::filesystem::exists(folder / "b.db-wal"));
  CHECK(Store::open(folder / "b.db").faults().empty());
  CHECK_FALSE(std::filesystem::exists(folder / "b.db-wal"));  // a writer removes the log
}

TEST_CASE("a store that was copied without its log is recognized") {
  const TemporaryFolder folder;
  Store writer = Store::create(folder / "a.db");
  writer.open_log();
  writer.add(plan({cooling()}));
  std::filesystem::copy_file(folder / "a.db", folder / "b.db");
  const Reader copy(folder / "b.db");
  CHECK(copy.lacks_log());
  CHECK(copy.jobs().empty());
  CHECK_FALSE(Reader(folder / "a.db").lacks_log());
  CHECK(writer.close_log({}));
  CHECK_FALSE(Reader(folder / "a.db").lacks_log());
}

TEST_CASE("one process copies the log, which begins anew and is gone with the last writer") {
  const TemporaryFolder folder;
  const auto log = folder / "a.db-wal";
  Store store = Store::create(folder / "a.db");
  CHECK_FALSE(std::filesystem::exists(log));
  store.open_log();
  store.add(plan({cooling()}));
  const Claim claim = *store.claim(me, "test");
  // Far more than the thousand pages at which SQLite would copy the log by itself.
  for (int k = 1; k <= 4; ++k)
    store.commit(claim.lease,
                 {.checkpoint = Checkpoint{.tau = 10.0 * k, .state = bytes(std::size_t{4} << 20)}});
  CHECK(std::filesystem::file_size(log) > (std::size_t{16} << 20));
  const LogSize copied = store.copy_log();
  CHECK(copied.is_copied);
  CHECK(copied.bytes == static_cast<std::int64_t>(std::filesystem::file_size(log)));
  store.commit(claim.lease, {.checkpoint = Checkpoint{.tau = 50, .state = bytes(1000)}});
  CHECK(std::filesystem::file_size(log) == static_cast<std::uintmax_t>(copied.bytes));
  {
    const Store other = Store::open(folder / "a.db");
    CHECK_FALSE(store.close_log({}));  // the log stays as long as another process uses it
  }
  CHECK(store.close_log({}));
  CHECK_FALSE(std::filesystem::exists(log));
  CHECK(store.faults().empty());
}

TEST_CASE("a reader that does not end keeps the log from beginning anew, and this is reported") {
  const TemporaryFolder folder;
  Store store = Store::create(folder / "a.db");
  store.open_log();
  store.add(plan({cooling()}));
  const Reader reader(folder / "a.db");
  Query query = reader.query("SELECT job_id FROM jobs");
  REQUIRE(query.next());
  CHECK(store.claim(me, "test"));
  CHECK_FALSE(store.copy_log().is_copied);
}

TEST_CASE("the loss of a store is noticed while it is written, and its data are saved") {
  const TemporaryFolder folder;
  const auto path = folder / "a.db";
  Store store = Store::create(path);
  store.open_log();
  store.add(plan({cooling()}));
  CHECK_FALSE(store.displaced());

  SUBCASE("deleted, with its log") {
    for (const char* suffix : {"", "-wal", "-shm"}) std::filesystem::remove(path.string() + suffix);
    CHECK(store.displaced() == "was deleted or moved away");
  }
  SUBCASE("moved away") {
    std::filesystem::rename(path, folder / "b.db");
    CHECK(store.displaced() == "was deleted or moved away");
  }
  SUBCASE("replaced by another store") {
    Store::create(folder / "b.db");
    std::filesystem::rename(folder / "b.db", path);
    CHECK(store.displaced() == "was replaced by another file");
    const std::string other = contents(path);
    CHECK_FALSE(store.close_log({}));
    CHECK(contents(path) == other);
  }
  SUBCASE("written over by another store") {
    store.copy_log();
    Store::create(folder / "b.db");
    std::filesystem::copy_file(folder / "b.db", path,
                               std::filesystem::copy_options::overwrite_existing);
    CHECK(store.displaced() == "was written over by another program");
    const std::string other = contents(path);
    CHECK_FALSE(store.close_log({}));
    store.abandon_log();
    CHECK(contents(path) == other);
    CHECK_FALSE(std::filesystem::exists(path.string() + "-wal"));
    return;  // its data are gone
  }
  SUBCASE("cut short") {
    store.copy_log();
    std::filesystem::resize_file(path, std::filesystem::file_size(path) - 1);
    CHECK(store.displaced() == "was written over by another program");
    return;
  }
  SUBCASE("without its log") {
    std::filesystem::remove(path.string() + "-wal");
    CHECK(store.displaced() == "has lost its log (a.db-wal), which was deleted or replaced");
  }
  store.back_up(folder / "saved.db");
  CHECK(Reader(folder / "saved.db").jobs().size() == 2);
}

TEST_CASE("a header that power loss left half copied is read from the log and repaired") {
  const TemporaryFolder folder;
  Store running = Store::create(folder / "a.db");
  running.open_log();
  running.add(plan({cooling(0.8)}));
  // New pages change the header, so that it is in the log.
  for (std::uint64_t seed = 2; seed < 60; ++seed) running.add(plan({cooling(0.8, seed)}));
  std::filesystem::copy_file(folder / "a.db", folder / "b.db");
  std::filesystem::copy_file(folder / "a.db-wal", folder / "b.db-wal");
  std::fstream(folder / "b.db", std::ios::binary | std::ios::in | std::ios::out)
      << std::string(512, 'x');
  CHECK(Reader(folder / "b.db").jobs().size() == running.jobs().size());
  const Store store = Store::open(folder / "b.db");
  CHECK(store.faults().empty());
}

TEST_CASE("a log beside a store that never had one belongs to another file") {
  const TemporaryFolder folder;
  Store::create(folder / "a.db").add(plan({cooling()}));
  Store running = Store::create(folder / "b.db");
  running.open_log();
  running.add(plan({cooling()}));
  std::filesystem::copy_file(folder / "b.db-wal", folder / "a.db-wal");
  const std::string whole = contents(folder / "a.db");
  CHECK(refusal([&] { Reader(folder / "a.db"); }).find("is that of another file") !=
        std::string::npos);
  CHECK(refusal([&] { Store::open(folder / "a.db"); }).find("is that of another file") !=
        std::string::npos);
  CHECK(contents(folder / "a.db") == whole);
}

TEST_CASE("a store with two names is not written") {
  const TemporaryFolder folder;
  Store::create(folder / "a.db");
  std::filesystem::create_hard_link(folder / "a.db", folder / "b.db");
  CHECK(refusal([&] { Store::open(folder / "b.db"); }).find("has 2 names (hard links)") !=
        std::string::npos);
  CHECK(Reader(folder / "b.db").jobs().empty());
}

TEST_CASE("a link to a running store gives what is written, from any folder") {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "live");
  std::filesystem::create_directory(folder / "links");
  std::filesystem::create_symlink("../live/a.db", folder / "links/a.db");
  Store store = Store::create(folder / "live/a.db");
  store.open_log();
  const Reader reader(folder / "links/a.db");
  store.add(plan({cooling()}));
  CHECK(reader.jobs().size() == 2);
  CHECK(Store::open(folder / "links/a.db").jobs().size() == 2);
  CHECK_FALSE(std::filesystem::exists(folder / "links/a.db-wal"));
}

TEST_CASE("readers leave nothing beside a store") {
  const TemporaryFolder folder;
  Store::create(folder / "a.db").add(plan({cooling()}));
  plain(folder / "a.db").exec("PRAGMA journal_mode = WAL");  // as older programs left their stores
  CHECK(Reader(folder / "a.db").jobs().size() == 2);
  int files = 0;
  for ([[maybe_unused]] const auto& file : std::filesystem::directory_iterator(folder.path()))
    ++files;
  CHECK(files == 1);
}

TEST_CASE("a new store has the permissions that the umask leaves") {
  const TemporaryFolder folder;
  const mode_t before = umask(0007);
  Store::create(folder / "a.db").open_log();
  umask(before);
  struct stat info {};
  REQUIRE(stat((folder / "a.db").c_str(), &info) == 0);
  CHECK((info.st_mode & 0777U) == 0660);
}
