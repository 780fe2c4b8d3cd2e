#include "schema/database.hpp"

#include <sqlite3.h>
#include <unistd.h>

#include <chrono>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "schema/embedded.hpp"
#include "schema/network.hpp"
#include "schema/store.hpp"
#include "schema/views.hpp"

namespace haff::schema {

namespace {

constexpr std::string_view in_memory = ":memory:";

// The scripts 001-....sql, 002-....sql in their order: a store's version is how many it has seen.
// Whatever brings a store to the newest version ends with the last one, and with it the views are
// made anew.
std::vector<std::string_view> scripts() {
  std::vector<std::string_view> texts;
  for (const Embedded& file : embedded())
    if (file.name.ends_with(".sql")) texts.push_back(file.text);
  static const std::string last_and_views = std::string(texts.back()) + mean_views_script();
  texts.back() = last_and_views;
  return texts;
}

int number(SQLite::Database& sqlite, const char* sql) {
  return sqlite.execAndGet(sql).getInt();
}

int version(SQLite::Database& sqlite) {
  return number(sqlite, "PRAGMA user_version");
}

bool empty(SQLite::Database& sqlite) {
  return number(sqlite, "SELECT count(*) FROM sqlite_schema") == 0 && version(sqlite) == 0 &&
         number(sqlite, "PRAGMA application_id") == 0;
}

std::string plan_first(const std::filesystem::path& path) {
  return "; make it with: campaign plan GRID.json --store " + path.string();
}

void must_exist(const std::filesystem::path& path) {
  if (std::error_code none; !std::filesystem::exists(path, none))
    throw StoreError(path.string() + ": there is no such store" + plan_first(path));
}

void must_be_store(SQLite::Database& sqlite, const std::filesystem::path& path) {
  if (number(sqlite, "PRAGMA application_id") != application_id)
    throw StoreError(path.string() +
                     ": is the SQLite file of another program; name a store with --store FILE");
}

void must_not_be_newer(int found, std::size_t known, const std::filesystem::path& path) {
  if (found > static_cast<int>(known))
    throw StoreError(path.string() + ": was written by a newer program (store version " +
                     std::to_string(found) + ", this one knows " + std::to_string(known) +
                     "); update campaign");
}

// A store on a medium that cannot be written, with no write-ahead log beside it, does not change:
// SQLite must be told so, since it would keep its locks in a file next to the store.
bool frozen(const std::filesystem::path& path) {
  const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  return access(folder.c_str(), W_OK) != 0 && !std::filesystem::exists(path.string() + "-wal");
}

std::string frozen_uri(const std::filesystem::path& path) {
  std::string uri = "file:";
  for (const char c : path.string()) {
    if (c == '%')
      uri += "%25";
    else if (c == '?')
      uri += "%3f";
    else if (c == '#')
      uri += "%23";
    else
      uri += c;
  }
  return uri + "?immutable=1";
}

SQLite::Database opened(const std::filesystem::path& path, Access access) {
  const int wait = static_cast<int>(busy_timeout.count());
  if (access == Access::create)
    return {path.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE, wait};
  must_exist(path);
  if (access == Access::write) return {path.string(), SQLite::OPEN_READWRITE, wait};
  if (frozen(path)) return {frozen_uri(path), SQLite::OPEN_READONLY | SQLite::OPEN_URI, wait};
  return {path.string(), SQLite::OPEN_READONLY, wait};
}

void prepare_to_read(SQLite::Database& sqlite, const std::filesystem::path& path) {
  if (empty(sqlite)) throw StoreError(path.string() + ": is empty" + plan_first(path));
  must_be_store(sqlite, path);
  const auto known = scripts().size();
  must_not_be_newer(version(sqlite), known, path);
  if (version(sqlite) < static_cast<int>(known))
    throw StoreError(path.string() + ": is of an older version (" +
                     std::to_string(version(sqlite)) + ", this program's is " +
                     std::to_string(known) + "); bring it forward with: campaign run --store " +
                     path.string());
  sqlite.exec("PRAGMA query_only = ON");
}

// The journal's mode after asking for the write-ahead log. Two processes that turn the same new
// file each hold the read lock the other must wait for: SQLite refuses one of them at once,
// whatever its timeout, since waiting inside would never end. So the loser tries again from the
// outside.
std::string write_ahead(SQLite::Database& sqlite) {
  constexpr std::chrono::milliseconds pause{5};
  const auto until = std::chrono::steady_clock::now() + busy_timeout;
  while (true) try {
      return sqlite.execAndGet("PRAGMA journal_mode = WAL").getString();
    } catch (const SQLite::Exception& error) {
      const bool busy = (error.getErrorCode() & 0xff) == SQLITE_BUSY;
      if (!busy || std::chrono::steady_clock::now() > until) throw;
      std::this_thread::sleep_for(pause);
    }
}

void prepare_to_write(SQLite::Database& sqlite, const std::filesystem::path& path) {
  if (sqlite3_db_readonly(sqlite.getHandle(), "main") == 1)
    throw StoreError(path.string() + ": may not be written; check the permissions of the file");
  // Somebody else's file must not change, not even its journal.
  if (!empty(sqlite)) must_be_store(sqlite, path);

  // The write-ahead log needs memory that all users share, which a network file system does not
  // give to several hosts. Campaign's lock lets one host use the store at a time.
  const bool on_network = path != in_memory && is_on_network(path);
  const auto journal = on_network ? sqlite.execAndGet("PRAGMA journal_mode = DELETE").getString()
                                  : write_ahead(sqlite);
  if (journal != "wal" && !on_network && path != in_memory)
    throw StoreError(path.string() +
                     ": this file system does not support SQLite's write-ahead log; "
                     "put the store on a local disk");
  // NORMAL: a commit reaches the operating system, not yet the disk. A killed process loses
  // nothing; power loss undoes the newest commits, and what they held is computed again with the
  // same bits, so that waiting for the disk at each commit would buy nothing.
  sqlite.exec("PRAGMA synchronous = NORMAL");
  sqlite.exec("PRAGMA foreign_keys = ON");
  // A replaced checkpoint need not be overwritten with zeros first.
  sqlite.exec("PRAGMA secure_delete = OFF");
  // The log grows to the largest commit, a checkpoint; give the space back afterwards. [bytes]
  sqlite.exec("PRAGMA journal_size_limit = 67108864");
  migrate(sqlite, path, scripts());
}

}  // namespace

Database::Database(const std::filesystem::path& path, Access access) try
    : path_(path), sqlite_(opened(path, access)) {
  if (access == Access::read)
    prepare_to_read(sqlite_, path_);
  else
    prepare_to_write(sqlite_, path_);
} catch (const SQLite::Exception& error) {
  raise(path, error);
}

void Database::wait_for_locks_while(bool (*may_wait)()) {
  // Called by SQLite each time it finds the lock taken; 0 ends the waiting.
  const auto wait = [](void* asked, int times) {
    constexpr std::chrono::milliseconds pause{10};
    const auto may_go_on = reinterpret_cast<bool (*)()>(asked);
    if (times * pause > busy_timeout || !may_go_on()) return 0;
    std::this_thread::sleep_for(pause);
    return 1;
  };
  sqlite3_busy_handler(sqlite_.getHandle(), wait, reinterpret_cast<void*>(may_wait));
}

void Database::raise(const std::filesystem::path& path, const SQLite::Exception& error) {
  const std::string file = path.string();
  const std::string said = error.what();
  switch (error.getErrorCode() & 0xff) {  // without SQLite's extension of the code
    case SQLITE_FULL:
    case SQLITE_IOERR:
      throw DiskError(file + ": the disk is full or fails (" + said +
                      "); nothing of this was stored. Make room, then give the same command again");
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      throw Locked(file + ": another process keeps it locked (" + said +
                   "); see what holds it, then give the same command again");
    case SQLITE_CORRUPT:
      throw Damage(file + ": is damaged (" + said + "); see: campaign verify --store " + file);
    case SQLITE_NOTADB:
      throw StoreError(file + ": is not an SQLite file; name a store with --store FILE");
    case SQLITE_CANTOPEN:
      throw StoreError(file + ": cannot be opened (" + said +
                       "); check that its folder exists and may be written");
    case SQLITE_READONLY:
      throw StoreError(file + ": may not be written (" + said + "); check its permissions");
    default:
      throw StoreError(file + ": " + said);
  }
}

void migrate(SQLite::Database& sqlite, const std::filesystem::path& path,
             std::span<const std::string_view> scripts) {
  if (version(sqlite) == static_cast<int>(scripts.size())) return;
  SQLite::Transaction transaction(sqlite, SQLite::TransactionBehavior::IMMEDIATE);
  const int from = version(sqlite);  // again: another process may just have done it
  must_not_be_newer(from, scripts.size(), path);
  for (std::size_t i = static_cast<std::size_t>(from); i < scripts.size(); ++i)
    sqlite.exec(std::string(scripts[i]));
  sqlite.exec("PRAGMA application_id = " + std::to_string(application_id));
  sqlite.exec("PRAGMA user_version = " + std::to_string(scripts.size()));
  transaction.commit();
}

}  // namespace haff::schema
