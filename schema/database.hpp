// One connection to a store: opening, versions, and SQLite's errors in our words. Private to this
// folder.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>
#include <span>
#include <string_view>
#include <utility>

#include "schema/column.hpp"
#include "schema/error.hpp"

namespace haff::schema {

// "Haff" in ASCII: marks the file as a store (`file campaign.db` shows it).
inline constexpr int application_id = 0x48616666;

// create: make the store if there is none. write: there must be one. read: SQLite refuses writes.
enum class Access { create, write, read };

class Database {
 public:
  Database(const std::filesystem::path& path, Access access);

  SQLite::Database& sqlite() { return sqlite_; }
  const std::filesystem::path& path() const { return path_; }

  // From here on waits for locks of other processes no longer than busy_timeout, nor than
  // `may_wait` allows, which is asked some times a second.
  void wait_for_locks_while(bool (*may_wait)());

  // Run what talks to SQLite, with its exceptions turned into those of error.hpp.
  template <class Work>
  auto guarded(Work&& work) {
    try {
      return std::forward<Work>(work)();
    } catch (const SQLite::Exception& error) {
      raise(path_, error);
    } catch (const BadValue& bad) {
      throw Damage(path_.string() + ": " + bad.what());
    }
  }

  // The same as one transaction that may write: it takes the write lock first, so that what it
  // reads is still true when it writes.
  template <class Work>
  auto transaction(Work&& work) {
    return guarded([&] {
      SQLite::Transaction transaction(sqlite_, SQLite::TransactionBehavior::IMMEDIATE);
      if constexpr (std::is_void_v<decltype(work())>) {
        work();
        transaction.commit();
      } else {
        auto result = work();
        transaction.commit();
        return result;
      }
    });
  }

  // The same as one transaction that reads: all of it sees the store at one moment.
  template <class Work>
  auto snapshot(Work&& work) {
    return guarded([&] {
      SQLite::Transaction transaction(sqlite_);
      return std::forward<Work>(work)();
    });
  }

 private:
  [[noreturn]] static void raise(const std::filesystem::path& path, const SQLite::Exception& error);

  std::filesystem::path path_;
  SQLite::Database sqlite_;
};

// Run those scripts that bring the store from its version (the number of scripts it has seen) to
// the last, in one transaction. Throws StoreError if it has seen more than there are.
void migrate(SQLite::Database& sqlite, const std::filesystem::path& path,
             std::span<const std::string_view> scripts);

}  // namespace haff::schema
