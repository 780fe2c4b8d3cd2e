// SPDX-License-Identifier: GPL-3.0-or-later

// One connection to a store: how it is opened, and SQLite's errors in our words. Private to this
// folder.
//
// A store at rest is one plain file. While a campaign runs, it has a write-ahead log beside it
// (-wal, with its index -shm), so that many processes may write while others read: open_log() and
// close_log(). schema/README.md says what that promises and why.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "schema/database/prepared.hpp"
#include "schema/database/versions.hpp"
#include "schema/digests/digests.hpp"
#include "schema/error.hpp"
#include "schema/file/file_system.hpp"
#include "schema/file/log.hpp"
#include "schema/file/name.hpp"
#include "schema/file/words.hpp"
#include "schema/rows/column.hpp"

namespace haff::schema {

// create: make the store if there is none. write: there must be one. read: SQLite refuses writes.
// upgrade: write, and bring a store of an older version forward.
enum class Access { create, write, read, upgrade };

class Database {
 public:
  Database(const std::filesystem::path& path, Access access);
  // One without a file, gone when it is closed.
  static std::unique_ptr<Database> in_memory();
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  SQLite::Database& sqlite() { return *sqlite_; }
  Digests& digests() {
    if (!digests_) digests_ = std::make_unique<Digests>(*sqlite_);
    return *digests_;
  }
  PreparedStatements& statements() {
    if (!statements_) statements_ = std::make_unique<PreparedStatements>(*sqlite_);
    return *statements_;
  }
  // The store as it is in the file: sqlite() may be a copy of it that was brought forward.
  SQLite::Database& original() { return original_ ? *original_ : *sqlite_; }
  const std::filesystem::path& path() const { return path_; }  // as the user named it
  const std::filesystem::path& file() const { return file_; }  // absolute, links followed

  // Brings a store that was opened to be upgraded to this program's version, then does `afterwards`
  // in the same transaction.
  void bring_forward(const std::function<void()>& afterwards = {});

  // From here on many processes may write while others read, until the last that writes closes the
  // log. Waits for processes that are reading.
  void open_log();
  // Copies what the log holds into the file, so that the log can begin anew. Only the process that
  // opened the log does it, and holds the write lock meanwhile: no commit, and no other
  // process's copying, may come in between (schema/README.md, "The WAL-reset bug").
  LogSize copy_log();
  // Back to one plain file, if no other process uses the store. False if one does.
  bool close_log(std::chrono::milliseconds patience = {});
  // What has happened to the file at the store's path, if it is no longer the one that is open.
  std::optional<std::string> displaced() const;
  // Takes the log of a file that is displaced from beside the one that is in its place: deletes it,
  // or keeps it under another name.
  void abandon_log(const std::filesystem::path& kept_as = {});
  // The file is prepared for a log, but the log was not there when the store was opened.
  bool lacks_log() const { return lacks_log_; }

  // From here on waits for locks of other processes no longer than busy_timeout, nor than
  // `may_wait` allows, which is asked some times a second.
  void wait_for_locks_while(bool (*may_wait)());

  // Run what talks to SQLite, with its exceptions turned into those of error.hpp.
  template <class Work>
  auto guarded(Work&& work) {
    before();
    try {
      if constexpr (std::is_void_v<decltype(work())>) {
        std::forward<Work>(work)();
        after();
      } else {
        auto result = std::forward<Work>(work)();
        after();
        return result;
      }
    } catch (const SQLite::Exception& error) {
      raise(path_, error);
    } catch (const Altered& altered) {
      throw Damage(path_.string() + ": " + altered.what(), Remedy::repair, path_);
    } catch (const BadValue& bad) {
      throw Damage(path_.string() + ": " + bad.what());
    }
  }

  // The same as one transaction that may write: it takes the write lock first, so that what it
  // reads is still true when it writes.
  template <class Work>
  auto transaction(Work&& work) {
    return guarded([&] {
      SQLite::Transaction transaction(*sqlite_, SQLite::TransactionBehavior::IMMEDIATE);
      must_be_of_this_version();
      const DigestsOfChanges of_changes(digests());
      if constexpr (std::is_void_v<decltype(work())>) {
        work();
        digests().settle();
        transaction.commit();
      } else {
        auto result = work();
        digests().settle();
        transaction.commit();
        return result;
      }
    });
  }

  // The same as one transaction that reads: all of it sees the store at one moment. Within a
  // transaction it is a part of that.
  template <class Work>
  auto snapshot(Work&& work) {
    return guarded([&] {
      std::optional<SQLite::Transaction> transaction;
      if (sqlite3_get_autocommit(sqlite_->getHandle()) != 0) transaction.emplace(*sqlite_);
      return std::forward<Work>(work)();
    });
  }

 private:
  Database();
  void open_to_read();
  void open_to_observe();
  void open_to_write(Access access);
  void remember_log();
  void before();
  void after() const;
  void must_be_of_this_version();

  std::filesystem::path path_, file_;
  std::unique_ptr<SQLite::Database> sqlite_;
  std::unique_ptr<Digests> digests_;                // of sqlite_
  std::unique_ptr<PreparedStatements> statements_;  // of sqlite_
  std::unique_ptr<SQLite::Database> original_;      // of an older version, or none
  std::unique_ptr<SQLite::Database> copier_;        // of the log
  std::optional<FileIdentity> file_identity_, log_identity_;
  std::int64_t copied_bytes_ = 0;  // of the file, when the log was last copied into it
  bool writes_ = false;
  bool lacks_log_ = false;
  // Of a store that is read without locks: the file as it was when it was opened.
  struct Stamp;
  std::unique_ptr<const Stamp> unlocked_;
};

}  // namespace haff::schema
