// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/database/backup.hpp"

#include <SQLiteCpp/Backup.h>
#include <fcntl.h>
#include <sqlite3.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "schema/file/flush.hpp"
#include "schema/file/journal.hpp"
#include "schema/file/patience.hpp"

namespace haff::schema {

namespace {

// Waits for a process that is writing the store when the copy is to begin.
void copy(SQLite::Database& from, SQLite::Database& to) {
  constexpr std::chrono::milliseconds pause{20};
  constexpr int all_pages = -1;
  SQLite::Backup backup(to, from);
  const auto until = std::chrono::steady_clock::now() + busy_timeout;
  for (int result = SQLITE_BUSY; result != SQLITE_DONE;) {
    result = backup.executeStep(all_pages);
    if (result == SQLITE_DONE) return;
    if (std::chrono::steady_clock::now() > until)
      throw SQLite::Exception("the store is locked", SQLITE_BUSY);
    std::this_thread::sleep_for(pause);
  }
}

// Running jobs are pending in the copy, of which their workers know nothing. A job whose row is
// damaged stays as it is and stays known as damaged. A copy of an older version has no digests.
void give_back_running_jobs(SQLite::Database& copy) {
  const bool has_digests = copy.tableExists("digests");
  Digests digests(copy);
  SQLite::Transaction transaction(copy, SQLite::TransactionBehavior::IMMEDIATE);
  std::vector<std::int64_t> running;
  SQLite::Statement jobs(copy, "SELECT job_id FROM jobs WHERE status = 'running'");
  while (jobs.executeStep()) running.push_back(jobs.getColumn(0).getInt64());
  if (has_digests) digests.begin();
  const bool is_renamed = version_of(copy) >= version_with("019-tau-reached.sql");
  SQLite::Statement give_back(
      copy,
      std::string(R"(
    UPDATE jobs SET
      status = 'pending', owner_boot_id = NULL, owner_pid = NULL, owner_started = NULL,
      renewed = NULL,
      )") +
          (is_renamed ? "tau_reached" : "tau") +
          R"( = coalesce((SELECT tau FROM checkpoints WHERE checkpoints.job_id = jobs.job_id), 0),
      collisions =
        coalesce((SELECT collisions FROM checkpoints WHERE checkpoints.job_id = jobs.job_id), 0)
    WHERE job_id = ?)");
  for (const std::int64_t job_id : running) {
    if (has_digests) try {
        digests.must_match(job_id, Part::jobs);
      } catch (const BadValue&) {
        continue;
      }
    give_back.reset();
    give_back.bind(1, job_id);
    give_back.exec();
  }
  if (has_digests) digests.settle();
  transaction.commit();
}

void must_be_sound(SQLite::Database& copy, const std::filesystem::path& store) {
  const std::string found = copy.execAndGet("PRAGMA integrity_check(1)").getString();
  if (found != "ok")
    throw DamagedFile(store.string() + ": is damaged (" + found +
                          "), and a copy of it would be; no backup was made",
                      Remedy::check, store);
}

[[noreturn]] void exists_already(const std::filesystem::path& to) {
  throw NameError(to.string() + ": exists already and is left alone; name another file");
}

// Unlike rename(2), replaces nothing.
void give_name(const std::filesystem::path& made, const std::filesystem::path& wanted,
               const std::filesystem::path& to) {
  if (renameat2(AT_FDCWD, made.c_str(), AT_FDCWD, wanted.c_str(), RENAME_NOREPLACE) != 0) {
    if (errno == EEXIST) exists_already(to);
    if (errno != EINVAL || identity_of(wanted) ||
        rename(made.c_str(), wanted.c_str()) != 0)  // a file system that cannot promise as much
      throw DiskError(to.string() + ": cannot be given its name (" +
                      std::generic_category().message(errno) + ")");
  }
  flush_to_disk(wanted.parent_path());
}

// A file that is gone with its owner, unless it was given another name.
class Unfinished {
 public:
  explicit Unfinished(std::filesystem::path file) : file_(std::move(file)) {}
  ~Unfinished() {
    for (const char* suffix : {"", "-journal"}) ::unlink((file_.string() + suffix).c_str());
  }
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;

  const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_;
};

}  // namespace

std::uintmax_t back_up(Database& database, const std::filesystem::path& to) {
  const auto wanted = resolved(to);
  if (identity_of(wanted)) exists_already(to);
  const Unfinished unfinished(wanted.string() + ".unfinished-" + std::to_string(getpid()));
  make(to, unfinished.file());
  try {
    SQLite::Database copied(unfinished.file().string(), SQLite::OPEN_READWRITE, 0, file_system());
    database.guarded([&] { copy(database.original(), copied); });
    copied.exec("PRAGMA synchronous = FULL");
    copied.exec("PRAGMA journal_mode = DELETE");
    must_be_sound(copied, database.path());
    give_back_running_jobs(copied);
  } catch (const SQLite::Exception& error) {
    raise(to, error);
  }
  draw_counter(unfinished.file());
  flush_to_disk(unfinished.file());
  const auto bytes = std::filesystem::file_size(unfinished.file());
  give_name(unfinished.file(), wanted, to);
  return bytes;
}

}  // namespace haff::schema
