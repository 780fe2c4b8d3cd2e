// SPDX-License-Identifier: GPL-3.0-or-later

// How a store is opened, brought forward, and closed.
#include "schema/database/database.hpp"
#include "schema/rows/column.hpp"
#include "schema/store/lease.hpp"
#include "schema/store/rows/checked_rows.hpp"
#include "schema/store/store.hpp"

namespace haff::schema {

Store Store::create(const std::filesystem::path& path) {
  return Store(std::make_unique<Database>(path, Access::create));
}

Store Store::open(const std::filesystem::path& path) {
  return Store(std::make_unique<Database>(path, Access::write));
}

Store Store::in_memory() {
  return Store(Database::in_memory());
}

int Store::upgrade(const std::filesystem::path& path, const std::vector<Lease>& dead) {
  Database database(path, Access::upgrade);
  return database.guarded([&] {
    SQLite::Database& sqlite = database.sqlite();
    const int before = version_of(sqlite);
    database.bring_forward([&] {
      for (const Lease& lease : dead)
        if (holds(database, lease) && is_as_written(database, lease.job_id))
          leave(database, lease, Status::pending);
      SQLite::Statement running(sqlite, "SELECT * FROM jobs WHERE status = 'running'");
      if (running.executeStep())
        throw StoreError(path.string() + ": job " + std::to_string(integer(running, "job_id")) +
                         " is being run by process " + std::to_string(owner(running).pid) + " on " +
                         owner(running).host +
                         ", a program of the older version; upgrade when its run has ended");
    });
    return before;
  });
}

void Store::open_log() {
  database().open_log();
}

LogSize Store::copy_log() {
  return database().copy_log();
}

bool Store::close_log(std::chrono::milliseconds patience) {
  return database().close_log(patience);
}

std::optional<std::string> Store::displaced() const {
  return database().displaced();
}

void Store::abandon_log(const std::filesystem::path& kept_as) {
  database().abandon_log(kept_as);
}

void Store::wait_for_locks_while(bool (*may_wait)()) {
  database().wait_for_locks_while(may_wait);
}

}  // namespace haff::schema
