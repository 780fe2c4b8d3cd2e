// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/database/database.hpp"

#include <SQLiteCpp/Backup.h>
#include <sqlite3.h>
#include <sys/stat.h>

#include <chrono>
#include <string>
#include <thread>

#include "schema/file/header.hpp"
#include "schema/file/journal.hpp"
#include "schema/file/network.hpp"
#include "schema/file/patience.hpp"
#include "schema/rows/measured.hpp"

namespace haff::schema {

namespace {

// SQLite's own limit is 1 GB. The largest row holds a chunk of a checkpoint. [bytes]
constexpr int longest_row = 4 * static_cast<int>(chunk_bytes);

constexpr const char* log_is_open = "UPDATE log SET is_open = 1 WHERE is_open = 0";
constexpr const char* log_is_closed = "UPDATE log SET is_open = 0 WHERE is_open = 1";

bool has_log(const std::filesystem::path& file) {
  std::error_code none;
  const auto log = beside(file, "-wal");
  return std::filesystem::exists(log, none) && std::filesystem::file_size(log, none) > 0;
}

// A file at rest has no log: SQLite deletes the log before the file says so, and the file says that
// there is a log before SQLite makes it. A log beside a file at rest belongs to a file that was
// there before, and SQLite would take its pages for pages of this file.
void must_be_log_of(SQLite::Database& sqlite, const std::filesystem::path& file,
                    const std::filesystem::path& name) {
  const auto is_at_rest = [&] {
    const auto header = header_of(sqlite);
    return header && header->is_of_database && !header->expects_log;
  };
  // Twice: a run may begin in between.
  if (!is_at_rest() || !has_log(file) || !is_at_rest()) return;
  const std::string log = beside(file, "-wal").string();
  throw StoreError(name.string() + ": the log beside it, " + log +
                   ", is that of another file, in whose place this one was put, or which was "
                   "deleted; SQLite would mix the two. Move the log away, to where that file is if "
                   "you still have it, then give the same command again");
}

std::string mode(SQLite::Database& sqlite) {
  return sqlite.execAndGet("PRAGMA journal_mode").getString();
}

// A store may come from another person, so that SQLite's protections against a crafted file are
// switched on. The schema itself is compared with ours before anything else is read (versions.hpp).
//
// TRUSTED_SCHEMA = 0 is not among them: SQLite 3.40 counts its own JSON functions, which our
// constraints and views use, as unsafe and would open no store. It would forbid functions with side
// effects in a foreign view, and there are none: no extension is loaded, no function of our own is
// registered, and the tokenizers of FTS3 stay closed.
void be_careful(SQLite::Database& sqlite) {
  sqlite3* handle = sqlite.getHandle();
  sqlite3_db_config(handle, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_ENABLE_FTS3_TOKENIZER, 0, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_ENABLE_LOAD_EXTENSION, 0, nullptr);
  sqlite3_limit(handle, SQLITE_LIMIT_LENGTH, longest_row);
  sqlite3_limit(handle, SQLITE_LIMIT_ATTACHED, 0);
  sqlite3_limit(handle, SQLITE_LIMIT_WORKER_THREADS, 0);
  sqlite.exec("PRAGMA cell_size_check = ON");
}

// The settings of a reader. No statement of a user may undo them, even as one of several in one
// text.
int allow_to_a_reader(void*, int action, const char* pragma, const char* value, const char*,
                      const char*) {
  if (action == SQLITE_ATTACH || action == SQLITE_DETACH) return SQLITE_DENY;
  if (action == SQLITE_PRAGMA && value != nullptr && std::string_view(pragma) == "query_only")
    return SQLITE_DENY;
  return SQLITE_OK;
}

void only_read(SQLite::Database& sqlite) {
  sqlite.exec("PRAGMA query_only = ON");
  sqlite3_set_authorizer(sqlite.getHandle(), allow_to_a_reader, nullptr);
}

std::unique_ptr<SQLite::Database> connection(const std::string& name, int flags,
                                             const char* way_to_the_disk) {
  auto sqlite = std::make_unique<SQLite::Database>(name, flags, 0, way_to_the_disk);
  be_patient(sqlite->getHandle());
  be_careful(*sqlite);
  return sqlite;
}

std::string immutable_uri(const std::filesystem::path& file) {
  std::string uri = "file://";
  for (const char c : file.string()) {
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

// A temporary copy of a store of an older version, brought forward, so that the store can be read
// as if it were of the newest.
std::unique_ptr<SQLite::Database> copy_brought_forward(SQLite::Database& old,
                                                       const std::filesystem::path& name) {
  auto copy = std::make_unique<SQLite::Database>("", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE,
                                                 0, file_system());
  SQLite::Backup(*copy, old).executeStep();
  migrate(*copy, name, scripts());
  be_patient(copy->getHandle());
  be_careful(*copy);
  return copy;
}

// Asks for the write-ahead log, and returns the mode of the journal after that. Two processes that
// ask at once each hold the read lock that the other must wait for. SQLite refuses one of them at
// once, whatever its timeout, since it would wait for ever; that one tries again here.
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

}  // namespace

// What changes when the file is written.
struct Database::Stamp {
  explicit Stamp(const std::filesystem::path& file) { stat(file.c_str(), &info); }

  bool operator==(const Stamp& other) const {
    return info.st_dev == other.info.st_dev && info.st_ino == other.info.st_ino &&
           info.st_size == other.info.st_size && info.st_mtim.tv_sec == other.info.st_mtim.tv_sec &&
           info.st_mtim.tv_nsec == other.info.st_mtim.tv_nsec;
  }

  struct stat info {};
};

Database::Database(const std::filesystem::path& path, Access access) try : path_(path) {
  forget_trouble();
  file_ = resolved(path);
  if (access != Access::create) must_exist(path, file_);
  must_be_journal_of(file_, path_);  // before SQLite sees the file and puts its journal back
  if (access == Access::read)
    open_to_read();
  else
    open_to_write(access);
} catch (const SQLite::Exception& error) {
  raise(path, error);
}

Database::Database() = default;

std::unique_ptr<Database> Database::in_memory() {
  std::unique_ptr<Database> database(new Database);
  database->path_ = database->file_ = "a store in memory";
  database->sqlite_ =
      connection(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE, file_system());
  database->bring_forward();
  database->sqlite_->exec("PRAGMA foreign_keys = ON");
  return database;
}

Database::~Database() {
  if (writes_) try {
      close_log();
    } catch (const StoreError&) {  // the log stays, and the next command uses it
    }
}

void Database::open_to_read() {
  unlocked_.reset();
  digests_.reset();
  statements_.reset();
  original_.reset();
  const bool log_exists = identity_of(beside(file_, "-wal")).has_value();
  if (may_write(file_)) {
    sqlite_ = connection(file_.string(), SQLite::OPEN_READWRITE, file_system());
    must_be_log_of(*sqlite_, file_, path_);
    // A log that was there stays there: its owner comes back for it.
    if (log_exists)
      sqlite3_db_config(sqlite_->getHandle(), SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
  } else {
    open_to_observe();
  }
  if (is_empty(*sqlite_))
    throw NameError(path_.string() + ": is empty (a plan that was cut off leaves such a file)",
                    Remedy::plan, path_);
  must_be_store(*sqlite_, path_);
  const int version = version_of(*sqlite_);
  const auto known = scripts().size();
  must_not_be_newer(version, known, path_);
  must_have_our_schema(*sqlite_, version, path_);
  // Another process may open or close the log between two of these looks, hence the second one.
  const auto is_announced = [this] {
    return sqlite_->execAndGet("SELECT is_open FROM log").getInt() == 1;
  };
  lacks_log_ = version >= version_with("018-log.sql") && !log_exists && mode(*sqlite_) == "wal" &&
               is_announced() && !has_log(file_) && is_announced();
  if (version < static_cast<int>(known)) {
    original_ = std::move(sqlite_);
    sqlite_ = copy_brought_forward(*original_, path_);
  }
  only_read(*sqlite_);
}

// Without the right to write the file, or to make others beside it.
void Database::open_to_observe() {
  const bool has_index = identity_of(beside(file_, "-shm")).has_value();
  if (has_log(file_) && !has_index)
    throw Unavailable(path_.string() +
                      ": its newest rows are in the log beside it, which cannot be read without "
                      "the right to write there; copy both files, " +
                      file_.filename().string() + " and " + file_.filename().string() +
                      "-wal, to a folder of yours and read that copy" + in_the_way(path_));
  try {
    sqlite_ = connection(file_.string(), SQLite::OPEN_READONLY, observer_file_system());
    must_be_log_of(*sqlite_, file_, path_);
    version_of(*sqlite_);  // the first look at the file
    return;
  } catch (const SQLite::Exception& error) {
    const bool asks_for_log = (error.getErrorCode() & 0xff) == SQLITE_CANTOPEN && !has_log(file_);
    if (!asks_for_log) throw;
  }
  // The file is prepared for a log that is not there: no process writes it now. It is read without
  // locks, and before() and after() look whether a process has begun to write it.
  forget_trouble();
  unlocked_ = std::make_unique<const Stamp>(file_);
  sqlite_ = connection(immutable_uri(file_), SQLite::OPEN_READONLY | SQLite::OPEN_URI,
                       observer_file_system());
}

void Database::open_to_write(Access access) {
  must_have_one_name(path_, file_);
  if (access == Access::create) make(path_, file_);
  sqlite_ = connection(file_.string(), SQLite::OPEN_READWRITE, file_system());
  must_be_log_of(*sqlite_, file_, path_);
  if (sqlite3_db_readonly(sqlite_->getHandle(), "main") == 1)
    throw StoreError(path_.string() + ": may not be written" + in_the_way(path_));
  const bool is_new = is_empty(*sqlite_);
  if (is_new && access != Access::create)
    throw NameError(path_.string() + ": is empty", Remedy::plan, path_);
  const int version = version_of(*sqlite_);
  const auto known = static_cast<int>(scripts().size());
  if (!is_new) {
    must_be_store(*sqlite_, path_);
    must_not_be_newer(version, scripts().size(), path_);
    must_have_our_schema(*sqlite_, version, path_);
  }
  if (is_new)
    bring_forward();
  else if (version < known && access != Access::upgrade)
    throw StoreError(path_.string() + ": is of an older version (" + std::to_string(version) +
                         ", this program's is " + std::to_string(known) + ") and can only be read",
                     Remedy::upgrade, path_);
  writes_ = true;
  file_identity_ = identity_of(file_);
  // The log is copied into the file by copy_log() alone.
  sqlite_->exec("PRAGMA wal_autocheckpoint = 0");
  // With a log, a commit reaches the operating system, not yet the disk. A killed process loses
  // nothing. Power loss undoes the newest commits, and what they held is computed again with the
  // same bits, so that waiting for the disk at each commit would gain nothing. Without a log each
  // commit waits for the disk: commits are few, and a plan is not computed again. EXTRA also waits
  // for the deletion of the journal, which otherwise could come back after power loss and undo the
  // commit, even if a log was made after it (open_log).
  sqlite_->exec(mode(*sqlite_) == "wal" ? "PRAGMA synchronous = NORMAL"
                                        : "PRAGMA synchronous = EXTRA");
  sqlite_->exec("PRAGMA foreign_keys = ON");
  // A replaced checkpoint need not be overwritten with zeros first.
  sqlite_->exec("PRAGMA secure_delete = OFF");
  // The log grows to the size of the largest commit, a checkpoint, and gives the space back
  // afterwards. [bytes]
  sqlite_->exec("PRAGMA journal_size_limit = 67108864");
  if (mode(*sqlite_) == "wal") remember_log();
}

void Database::bring_forward(const std::function<void()>& afterwards) {
  // The scripts may change the schema's text (004-effects.sql), which no other statement may.
  sqlite3_db_config(sqlite_->getHandle(), SQLITE_DBCONFIG_DEFENSIVE, 0, nullptr);
  migrate(*sqlite_, path_, scripts(), [&] {
    const DigestsOfChanges of_changes(digests());
    digests().digest_tables();
    if (afterwards) afterwards();
    digests().settle();
  });
  sqlite3_db_config(sqlite_->getHandle(), SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
}

void Database::wait_for_locks_while(bool (*may_wait)()) {
  be_patient(sqlite_->getHandle(), may_wait);
}

// A log needs memory that all users share. A network file system cannot give it to several hosts:
// there a store stays a plain file, and a lock of the program lets one host use it at a time.
void Database::open_log() {
  if (is_on_network(file_)) {
    close_log();
    return;
  }
  guarded([&] {
    if (write_ahead(*sqlite_) != "wal")
      throw StoreError(path_.string() +
                       ": this file system does not support SQLite's write-ahead log; put the "
                       "store on a local disk");
    sqlite_->exec("PRAGMA synchronous = NORMAL");
    remember_log();
    sqlite_->exec(log_is_open);
  });
  copy_log();  // so that the file says that there is a log before anything else is written
}

// SQLite opens the log when it first needs it, and keeps that file open from then on.
void Database::remember_log() {
  { const SQLite::Transaction first(*sqlite_, SQLite::TransactionBehavior::IMMEDIATE); }
  log_identity_ = identity_of(beside(file_, "-wal"));
}

std::optional<std::string> Database::displaced() const {
  if (!file_identity_) return std::nullopt;  // in memory
  const auto there = identity_of(file_);
  if (!there) return "was deleted or moved away";
  if (there != file_identity_) return "was replaced by another file";
  if (log_identity_ && identity_of(beside(file_, "-wal")) != log_identity_)
    return "has lost its log (" + beside(file_, "-wal").filename().string() +
           "), which was deleted or replaced";
  // While there is a log, only copy_log() writes the file, and never makes it shorter.
  const auto header = header_of(*sqlite_);
  if (log_identity_ && header && (!header->expects_log || header->bytes < copied_bytes_))
    return "was written over by another program";
  return std::nullopt;
}

LogSize Database::copy_log() {
  if (!log_identity_) return {};
  return guarded([&] {
    if (!copier_) {
      copier_ = connection(file_.string(), SQLite::OPEN_READWRITE, file_system());
      copier_->exec("PRAGMA wal_autocheckpoint = 0");
      copier_->exec("PRAGMA synchronous = NORMAL");
    }
    const SQLite::Transaction no_commits_meanwhile(*sqlite_,
                                                   SQLite::TransactionBehavior::IMMEDIATE);
    int frames = 0;
    int copied = 0;
    const int result = sqlite3_wal_checkpoint_v2(copier_->getHandle(), "main",
                                                 SQLITE_CHECKPOINT_PASSIVE, &frames, &copied);
    if (result != SQLITE_OK) throw SQLite::Exception(copier_->getHandle(), result);
    if (const auto header = header_of(*sqlite_); header && copied == frames)
      copied_bytes_ = header->bytes;
    std::error_code none;
    const auto bytes = std::filesystem::file_size(beside(file_, "-wal"), none);
    return LogSize{.bytes = none ? 0 : static_cast<std::int64_t>(bytes),
                   .is_copied = copied == frames};
  });
}

bool Database::close_log(std::chrono::milliseconds patience) {
  constexpr std::chrono::milliseconds pause{20};
  const auto leave_log = [&] {
    sqlite3_db_config(sqlite_->getHandle(), SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
  };
  const auto is_displaced = [&] {
    if (!displaced()) return false;
    // SQLite would copy the log into the file that took our place, or delete that file's own log.
    leave_log();
    return true;
  };
  copier_.reset();
  if (is_displaced()) return false;
  const auto until = std::chrono::steady_clock::now() + patience;
  while (true) try {
      if (mode(*sqlite_) != "wal") return true;
      sqlite_->exec(log_is_closed);
      if (sqlite_->execAndGet("PRAGMA journal_mode = DELETE").getString() != "wal") {
        log_identity_.reset();
        return true;
      }
      throw SQLite::Exception("the log stays", SQLITE_BUSY);
    } catch (const SQLite::Exception& error) {
      if (is_displaced()) return false;
      const bool is_busy = (error.getErrorCode() & 0xff) == SQLITE_BUSY;
      if (!is_busy || std::chrono::steady_clock::now() >= until) {
        // SQLite would delete the log of a file that says that it has one.
        leave_log();
        sqlite_->tryExec(log_is_open);
        if (!is_busy) raise(path_, error);
        return false;
      }
      std::this_thread::sleep_for(pause);
    }
}

void Database::abandon_log(const std::filesystem::path& kept_as) {
  const auto log = beside(file_, "-wal");
  if (!log_identity_ || identity_of(log) != log_identity_) return;
  std::error_code ignored;
  if (kept_as.empty())
    std::filesystem::remove(log, ignored);
  else
    std::filesystem::rename(log, kept_as, ignored);
  std::filesystem::remove(beside(file_, "-shm"), ignored);
}

// From the moment when another process begins to write it, a file that was read without locks is
// read with them.
void Database::before() {
  forget_trouble();
  if (unlocked_ && (has_log(file_) || *unlocked_ != Stamp(file_))) try {
      open_to_read();
    } catch (const SQLite::Exception& error) {
      raise(path_, error);
    }
}

void Database::after() const {
  if (unlocked_ && *unlocked_ != Stamp(file_))
    throw Unavailable(path_.string() +
                      ": was written while it was being read; give the same command again");
}

void Database::must_be_of_this_version() {
  Prepared statement(*this, "PRAGMA user_version");
  statement.executeStep();
  const int version = statement.getColumn(0).getInt();
  if (version != static_cast<int>(scripts().size()))
    throw StoreError(path_.string() + ": was brought forward to version " +
                     std::to_string(version) +
                     " by a newer program while this one used it; update campaign");
}

}  // namespace haff::schema
