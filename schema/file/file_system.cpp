// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/file/file_system.hpp"

#include <sqlite3.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <new>
#include <string_view>
#include <system_error>

#include "schema/file/passing_file.hpp"

namespace haff::schema {

namespace {

// It is remembered without memory from the heap, of which there may be none left.
struct Note {
  bool exists = false;
  Operation operation = Operation::read;
  int error = 0;
  bool foreign_journal = false;
  std::array<char, 1024> file{};
};
thread_local Note last;

void note(Operation operation, const char* file, int error, bool foreign_journal = false) {
  last.exists = true;
  last.operation = operation;
  last.error = error;
  last.foreign_journal = foreign_journal;
  const std::size_t length =
      file == nullptr ? 0 : std::min(std::strlen(file), last.file.size() - 1);
  if (length > 0) std::memcpy(last.file.data(), file, length);
  last.file[length] = '\0';
}

// An open file: ours, followed in memory by that of the VFS below.
struct File {
  sqlite3_file base;
  const char* name;  // nullptr: temporary. SQLite keeps it as long as the file is open.
};

File* own(sqlite3_file* file) {
  return schema::own<File>(file);
}

sqlite3_file* below(sqlite3_file* file) {
  return schema::below<File>(file);
}

int system_error(sqlite3_file* file) {
  int error = 0;
  below(file)->pMethods->xFileControl(below(file), SQLITE_FCNTL_LAST_ERRNO, &error);
  return error;
}

int noted(int result, sqlite3_file* file, Operation operation) {
  if (result != SQLITE_OK) note(operation, own(file)->name, system_error(file));
  return result;
}

int read(sqlite3_file* file, void* to, int size, sqlite3_int64 offset) {
  const int result = below(file)->pMethods->xRead(below(file), to, size, offset);
  if (result == SQLITE_OK || result == SQLITE_IOERR_SHORT_READ) return result;
  noted(result, file, Operation::read);
  return result == SQLITE_IOERR_CORRUPTFS ? SQLITE_IOERR_READ : result;
}

int write(sqlite3_file* file, const void* from, int size, sqlite3_int64 offset) {
  return noted(below(file)->pMethods->xWrite(below(file), from, size, offset), file,
               Operation::write);
}

int truncate(sqlite3_file* file, sqlite3_int64 size) {
  return noted(below(file)->pMethods->xTruncate(below(file), size), file, Operation::truncate);
}

// A signal that interrupts a sync has not made it fail.
int sync(sqlite3_file* file, int flags) {
  constexpr int patience = 100;
  int result = SQLITE_OK;
  for (int attempt = 0; attempt < patience; ++attempt) {
    result = below(file)->pMethods->xSync(below(file), flags);
    if (result == SQLITE_OK || system_error(file) != EINTR) break;
  }
  return noted(result, file, Operation::sync);
}

int size_of(sqlite3_file* file, sqlite3_int64* size) {
  return noted(below(file)->pMethods->xFileSize(below(file), size), file, Operation::read);
}

// Waiting for a lock that another process holds is no trouble.
int lock(sqlite3_file* file, int level) {
  const int result = below(file)->pMethods->xLock(below(file), level);
  return result == SQLITE_BUSY ? result : noted(result, file, Operation::lock);
}

int unlock(sqlite3_file* file, int level) {
  return noted(below(file)->pMethods->xUnlock(below(file), level), file, Operation::lock);
}

int reserved_lock(sqlite3_file* file, int* is_held) {
  return noted(below(file)->pMethods->xCheckReservedLock(below(file), is_held), file,
               Operation::lock);
}

int map_shared(sqlite3_file* file, int region, int size, int extend, void volatile** memory) {
  const int result = below(file)->pMethods->xShmMap(below(file), region, size, extend, memory);
  const int kind = result & 0xff;
  // BUSY, READONLY and their like are answers, which SQLite knows what to do with. The file of the
  // index is not that of LAST_ERRNO.
  if (kind == SQLITE_IOERR || kind == SQLITE_CANTOPEN || kind == SQLITE_NOMEM)
    note(Operation::map, own(file)->name, errno);
  return result;
}

constexpr sqlite3_io_methods methods = [] {
  sqlite3_io_methods ours = passing_methods<File>();
  ours.xRead = read;
  ours.xWrite = write;
  ours.xTruncate = truncate;
  ours.xSync = sync;
  ours.xFileSize = size_of;
  ours.xLock = lock;
  ours.xUnlock = unlock;
  ours.xCheckReservedLock = reserved_lock;
  ours.xShmMap = map_shared;
  return ours;
}();

sqlite3_vfs* system_below(sqlite3_vfs* vfs) {
  return static_cast<sqlite3_vfs*>(vfs->pAppData);
}

int open(sqlite3_vfs* vfs, const char* name, sqlite3_file* file, int flags, int* out_flags) {
  file->pMethods = nullptr;
  own(file)->name =
      (flags & (SQLITE_OPEN_MAIN_DB | SQLITE_OPEN_MAIN_JOURNAL | SQLITE_OPEN_WAL)) != 0 ? name
                                                                                        : nullptr;
  if ((flags & SQLITE_OPEN_SUPER_JOURNAL) != 0) {
    note(Operation::open, name, EPERM, true);
    return SQLITE_CANTOPEN;
  }
  sqlite3_vfs* system = system_below(vfs);
  const int result = system->xOpen(system, name, below(file), flags, out_flags);
  if (result != SQLITE_OK) {
    note(Operation::open, own(file)->name, errno);
    return result;
  }
  file->pMethods = &methods;
  return SQLITE_OK;
}

int open_as_observer(sqlite3_vfs* vfs, const char* name, sqlite3_file* file, int flags,
                     int* out_flags) {
  constexpr int temporary = SQLITE_OPEN_TEMP_DB | SQLITE_OPEN_TEMP_JOURNAL |
                            SQLITE_OPEN_TRANSIENT_DB | SQLITE_OPEN_SUBJOURNAL;
  if ((flags & temporary) == 0) flags &= ~SQLITE_OPEN_CREATE;
  return open(vfs, name, file, flags, out_flags);
}

bool ends_with_journal(std::string_view name) {
  return name.ends_with("-journal") || name.ends_with("-wal");
}

int remove(sqlite3_vfs* vfs, const char* name, int sync_folder) {
  if (!ends_with_journal(name)) {
    note(Operation::remove, name, EPERM, true);
    return SQLITE_IOERR_DELETE;
  }
  sqlite3_vfs* system = system_below(vfs);
  const int result = system->xDelete(system, name, sync_folder);
  if (result == SQLITE_OK || result == SQLITE_IOERR_DELETE_NOENT) return result;
  note(Operation::remove, name, errno);
  // A log is deleted when the file has all of it, while no other process may look. A log that
  // stayed would be taken for that of another file; an empty log counts as none.
  std::error_code none;
  if (std::string_view(name).ends_with("-wal")) std::filesystem::resize_file(name, 0, none);
  return result;
}

using Open = int (*)(sqlite3_vfs*, const char*, sqlite3_file*, int, int*);

// A copy of the system's VFS, which keeps all that is not about files: time, random numbers.
sqlite3_vfs made(const char* name, Open how) {
  sqlite3_vfs* system = sqlite3_vfs_find(nullptr);
  sqlite3_vfs vfs = *system;
  vfs.zName = name;
  vfs.pNext = nullptr;
  vfs.pAppData = system;
  vfs.szOsFile = static_cast<int>(sizeof(File)) + system->szOsFile;
  vfs.xOpen = how;
  vfs.xDelete = remove;
  return vfs;
}

const char* registered(sqlite3_vfs& vfs) {
  if (sqlite3_vfs_register(&vfs, 0) != SQLITE_OK) throw std::bad_alloc();
  return vfs.zName;
}

}  // namespace

const char* file_system() {
  static sqlite3_vfs vfs = made("haff", open);
  static const char* name = registered(vfs);
  return name;
}

const char* observer_file_system() {
  static sqlite3_vfs vfs = made("haff-observer", open_as_observer);
  static const char* name = registered(vfs);
  return name;
}

std::optional<Trouble> last_trouble() {
  if (!last.exists) return std::nullopt;
  return Trouble{.operation = last.operation,
                 .file = last.file.data(),
                 .error = last.error,
                 .foreign_journal = last.foreign_journal};
}

void forget_trouble() {
  last.exists = false;
}

std::string temporary_folder() {
  for (const char* folder :
       {static_cast<const char*>(std::getenv("SQLITE_TMPDIR")),
        static_cast<const char*>(std::getenv("TMPDIR")), "/var/tmp", "/usr/tmp", "/tmp"}) {
    struct stat info {};
    if (folder != nullptr && stat(folder, &info) == 0 && S_ISDIR(info.st_mode) &&
        access(folder, W_OK | X_OK) == 0)
      return folder;
  }
  return ".";
}

}  // namespace haff::schema
