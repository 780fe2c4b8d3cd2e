// Opening a store: what is made, what is brought forward, what is refused.
#include "schema/database.hpp"

#include <doctest/doctest.h>
#include <sys/stat.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>

#include "fixture.hpp"
#include "schema/embedded.hpp"

using namespace haff::schema;

namespace {

std::string contents(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// Somebody else's connection: plain SQLite.
SQLite::Database plain(const std::filesystem::path& path) {
  return {path.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE};
}

// The version of a store that has seen all scripts.
int newest_version() {
  return static_cast<int>(std::ranges::count_if(
      embedded(), [](const Embedded& file) { return file.name.ends_with(".sql"); }));
}

template <class Open>
std::string refusal(Open open) {
  try {
    open();
  } catch (const StoreError& error) {
    return error.what();
  }
  return "not refused";
}

}  // namespace

TEST_CASE("a new store is marked as one") {
  const TemporaryFolder folder;
  Store::create(folder / "a.db");
  SQLite::Database sqlite = plain(folder / "a.db");
  CHECK(sqlite.execAndGet("PRAGMA application_id").getInt() == application_id);
  CHECK(sqlite.execAndGet("PRAGMA user_version").getInt() == newest_version());
  CHECK(sqlite.execAndGet("PRAGMA journal_mode").getString() == "wal");
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
  const Store store = Store::create(":memory:");
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

TEST_CASE("a store that must be there is not made") {
  const TemporaryFolder folder;
  const auto path = folder / "a.db";
  const std::string message = path.string() +
                              ": there is no such store; make it with: campaign plan GRID.json "
                              "--store " +
                              path.string();
  CHECK(refusal([&] { Store::open(path); }) == message);
  CHECK(refusal([&] { Reader{path}; }) == message);
  CHECK_FALSE(std::filesystem::exists(path));
}

TEST_CASE("a store in a folder that does not exist is refused") {
  const TemporaryFolder folder;
  const auto path = folder / "no/a.db";
  CHECK(refusal([&] { Store::create(path); }).starts_with(path.string() + ": cannot be opened"));
}

TEST_CASE("an empty file becomes a store, but is none yet") {
  const TemporaryFolder folder;
  const auto path = folder / "a.db";
  std::ofstream empty(path);
  CHECK(refusal([&] { Reader{path}; }).starts_with(path.string() + ": is empty; make it with"));
  Store::create(path);
  CHECK(Reader(path).jobs().empty());
}

TEST_CASE("a file that is not SQLite's is refused and left alone") {
  const TemporaryFolder folder;
  const auto path = folder / "a.db";
  std::ofstream(path) << std::string(5000, 'x');
  const std::string message =
      path.string() + ": is not an SQLite file; name a store with --store FILE";
  CHECK(refusal([&] { Store::create(path); }) == message);
  CHECK(refusal([&] { Reader{path}; }) == message);
  CHECK(contents(path) == std::string(5000, 'x'));
}

TEST_CASE("another program's SQLite file is refused and left alone") {
  const TemporaryFolder folder;
  const auto path = folder / "a.db";
  plain(path).exec("CREATE TABLE songs (title TEXT)");
  const std::string before = contents(path);
  const std::string message =
      path.string() + ": is the SQLite file of another program; name a store with --store FILE";
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

TEST_CASE("migration runs the scripts a store has not seen, once") {
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

// An identity as the stores up to version 7 have it.
std::string with_precision(std::string identity) {
  return identity.insert(identity.find(R"(,"sample_every":)"), R"(,"precision":"double")");
}

}  // namespace

TEST_CASE("a store of the first version is brought forward with its rows") {
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
  Store store = Store::open(path);
  CHECK(store.find(job) == 1);
  REQUIRE(store.samples(1).size() == 1);
  CHECK(store.samples(1)[0].temperature == 0.5);
  CHECK_FALSE(store.samples(1)[0].largest_cluster);
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
      CHECK(std::string(error.what()) == "attempt to write a readonly database");
    }
  }
  CHECK(Reader(folder / "a.db").jobs().size() == 2);
  CHECK(reader.sqlite().execAndGet("PRAGMA user_version").getInt() == newest_version());
}

TEST_CASE("readers see a store that a killed writer left with its log") {
  const TemporaryFolder folder;
  const Store store = [&] {
    Store writer = Store::create(folder / "a.db");
    writer.add(plan({cooling()}));
    return writer;
  }();
  // What a crash leaves behind: the log, not yet copied into the file.
  for (const char* suffix : {"", "-wal"})
    std::filesystem::copy_file((folder / "a.db").string() + suffix,
                               (folder / "b.db").string() + suffix);
  CHECK(Reader(folder / "b.db").jobs().size() == 2);
  CHECK(Store::open(folder / "b.db").faults().empty());
}
