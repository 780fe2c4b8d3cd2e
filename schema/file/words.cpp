// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/file/words.hpp"

#include <pwd.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <fstream>
#include <set>
#include <sstream>
#include <system_error>

#include "schema/error.hpp"
#include "schema/file/file_system.hpp"

namespace haff::schema {

namespace {

constexpr std::array<const char*, 4> parts{"", "-journal", "-wal", "-shm"};

std::string reason(int error) {
  return std::generic_category().message(error);
}

std::string owner_of(const struct stat& info) {
  const passwd* owner = getpwuid(info.st_uid);
  return owner != nullptr ? owner->pw_name : "user " + std::to_string(info.st_uid);
}

std::string mode_of(const struct stat& info) {
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "%04o", info.st_mode & 07777U);
  return text.data();
}

std::string name_of(const std::filesystem::path& store, const Trouble& trouble) {
  return trouble.file.empty() ? "a temporary file of SQLite in " + temporary_folder()
         : trouble.file.ends_with("-wal") || trouble.file.ends_with("-journal") ? trouble.file
                                                                                : store.string();
}

const char* done_to(Operation operation) {
  switch (operation) {
    case Operation::open:
      return "opened";
    case Operation::read:
      return "read";
    case Operation::write:
      return "written";
    case Operation::sync:
      return "flushed to the disk";
    case Operation::truncate:
      return "cut to size";
    case Operation::remove:
      return "deleted";
    case Operation::lock:
      return "locked";
    case Operation::map:
      return "mapped into memory";
  }
  return "used";
}

bool writes(Operation operation) {
  return operation == Operation::write || operation == Operation::sync ||
         operation == Operation::truncate || operation == Operation::remove;
}

bool is_full(int error) {
  return error == ENOSPC || error == EDQUOT || error == EFBIG;
}

std::string advice(int error) {
  switch (error) {
    case EMFILE:
    case ENFILE:
      return "too many files are open; allow for more (ulimit -n) or run fewer workers";
    case ENOMEM:
      return "no memory is left; close other programs or run fewer workers";
    case EIO:
      return "the disk or the network it is on answers with an error, which says nothing about "
             "what is stored; look into the system's log (dmesg), then give the same command "
             "again";
    case EINTR:
      return "a signal came in between; give the same command again";
    case EACCES:
    case EPERM:
    case EROFS:
      return "check the permissions of the file and of its folder";
    default:
      return "give the same command again";
  }
}

[[noreturn]] void foreign_journal(const std::filesystem::path& store, const Trouble& trouble) {
  throw StoreError(
      store.string() + ": the rollback journal beside it names another file, " + trouble.file +
          ", to be deleted. This program never writes such a journal, and the file was left alone. "
          "If the store came from another person, delete " +
          store.string() + "-journal, then check the store",
      Remedy::check, store);
}

[[noreturn]] void full(const std::filesystem::path& store, const Trouble& trouble) {
  if (trouble.file.empty())
    throw DiskError(store.string() + ": the folder for temporary files, " + temporary_folder() +
                    ", is full (" + reason(trouble.error) +
                    "); the store is as it was. Make room there, or name another folder in the "
                    "environment variable TMPDIR, then give the same command again");
  throw DiskError(store.string() + ": the disk is full (" + reason(trouble.error) +
                  "); nothing of this was stored. Make room, then give the same command again");
}

// An operation on a file failed.
[[noreturn]] void failed(const std::filesystem::path& store, const Trouble& trouble) {
  if (trouble.foreign_journal) foreign_journal(store, trouble);
  if (is_full(trouble.error)) full(store, trouble);
  const std::string text = store.string() + ": " + name_of(store, trouble) + " cannot be " +
                           done_to(trouble.operation) +
                           (trouble.error != 0 ? " (" + reason(trouble.error) + ")" : "") + "; ";
  const bool denied = trouble.error == EACCES || trouble.error == EPERM || trouble.error == EROFS;
  const std::string next =
      denied && !in_the_way(store).empty() ? in_the_way(store).substr(2) : advice(trouble.error);
  if (writes(trouble.operation))
    throw DiskError(text + "nothing of this was stored. What to do: " + next);
  throw Unavailable(text + next);
}

[[noreturn]] void no_memory(const std::filesystem::path& store) {
  throw Unavailable(store.string() + ": " + advice(ENOMEM) +
                    ". Nothing of this was stored, and what is stored is as it was");
}

// The SQLite file of another kind, or one of ours whose first page is damaged? Only asked when
// SQLite could not read it at all, and holds no lock that closing the file would drop.
bool bears_our_mark(const std::filesystem::path& store) {
  constexpr std::streamoff place = 68;  // of the application id (sqlite.org/fileformat.html)
  std::ifstream file(store, std::ios::binary);
  file.seekg(place);
  std::string mark(4, '\0');
  file.read(mark.data(), 4);
  return file && mark == "Haff";
}

// The name by which it was called: a program that started itself anew is "exe" in comm.
std::string command_name(const std::string& process) {
  std::string name;
  std::getline(std::ifstream("/proc/" + process + "/cmdline"), name, '\0');
  return std::filesystem::path(name).filename().string();
}

}  // namespace

std::string in_the_way(const std::filesystem::path& store) {
  std::error_code none;
  const auto resolved = std::filesystem::weakly_canonical(store, none);
  for (const char* part : parts) {
    const std::string name = resolved.string() + part;
    struct stat info {};
    if (stat(name.c_str(), &info) != 0 || access(name.c_str(), W_OK) == 0) continue;
    if (errno == EROFS) return "; it is on a file system that is mounted read-only";
    return "; " + name + " belongs to " + owner_of(info) + " (mode " + mode_of(info) +
           ") and you may not write it" +
           (*part == '\0' ? ""
                          : ": ask its owner to delete it if nothing runs on the store, or for the "
                            "right to write it");
  }
  const std::string folder = resolved.parent_path().string();
  struct stat info {};
  if (stat(folder.c_str(), &info) == 0 && access(folder.c_str(), W_OK) != 0)
    return errno == EROFS
               ? "; it is on a file system that is mounted read-only"
               : "; its folder, " + folder + ", belongs to " + owner_of(info) + " (mode " +
                     mode_of(info) + ") and you may not make files in it, which writing takes";
  return "";
}

std::string lock_holders(const std::filesystem::path& store) {
  std::error_code none;
  const auto resolved = std::filesystem::weakly_canonical(store, none);
  std::set<std::string> files;  // as /proc/locks names them: device and inode
  for (const char* part : parts) {
    struct stat info {};
    if (stat((resolved.string() + part).c_str(), &info) != 0) continue;
    std::array<char, 64> name{};
    std::snprintf(name.data(), name.size(), "%02x:%02x:%lu", major(info.st_dev), minor(info.st_dev),
                  static_cast<unsigned long>(info.st_ino));
    files.insert(name.data());
  }
  std::set<std::string> readers, writers;
  std::ifstream locks("/proc/locks");
  for (std::string line; std::getline(locks, line);) {
    std::istringstream words(line);
    std::string number, type, advisory, kind, process, file;
    words >> number >> type >> advisory >> kind >> process >> file;
    if (!files.contains(file) || process == std::to_string(getpid())) continue;
    (kind == "WRITE" ? writers : readers).insert(process);
  }
  // The workers of a run only read most of the time: they are named where no process writes.
  const auto& processes = writers.empty() ? readers : writers;
  std::string text;
  for (const std::string& process : processes)
    text +=
        (text.empty() ? "process " : ", process ") + process + " (" + command_name(process) + ")";
  return text;
}

void raise(const std::filesystem::path& store, const SQLite::Exception& error) {
  const std::string file = store.string();
  const std::string said = error.what();
  const Trouble trouble = last_trouble().value_or(Trouble{});
  const bool known = last_trouble().has_value();
  forget_trouble();
  if (error.getExtendedErrorCode() == SQLITE_IOERR_NOMEM) no_memory(store);
  switch (error.getErrorCode() & 0xff) {  // without SQLite's extension of the code
    case SQLITE_NOMEM:
      no_memory(store);
    case SQLITE_FULL:
      full(store,
           known && is_full(trouble.error) ? trouble : Trouble{.file = file, .error = ENOSPC});
    case SQLITE_IOERR:
    case SQLITE_CANTOPEN:
      if (known) failed(store, trouble);
      throw Unavailable(file + ": cannot be used (" + said + ")" + in_the_way(store));
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
    case SQLITE_PROTOCOL: {
      const std::string holders = lock_holders(store);
      throw Locked(file + ": " + (holders.empty() ? "another process" : holders) +
                   " keeps it locked (" + said +
                   "); see what holds it, then give the same command again");
    }
    case SQLITE_INTERRUPT:
      throw Unavailable(file + ": what was asked of it was stopped by a signal");
    case SQLITE_CORRUPT:
      throw DamagedFile(file + ": is damaged (" + said + ")", Remedy::check, store);
    case SQLITE_NOTADB:
      if (bears_our_mark(store))
        throw DamagedFile(file +
                          ": is damaged: its first page is no longer that of an SQLite file");
      throw NameError(file + ": is not an SQLite file", Remedy::name_a_store);
    case SQLITE_READONLY:
      if (error.getExtendedErrorCode() == SQLITE_READONLY_ROLLBACK)
        throw Unavailable(file +
                          ": a command that wrote to it was cut off, and what it began must be "
                          "undone before the store can be read, which takes the right to write "
                          "it" +
                          in_the_way(store));
      if (error.getExtendedErrorCode() == SQLITE_READONLY_DBMOVED)
        throw Unavailable(file + ": was deleted, moved away or replaced while it was used");
      throw StoreError(file + ": may not be written (" + said + ")" + in_the_way(store));
    default:
      throw StoreError(file + ": " + said);
  }
}

}  // namespace haff::schema
