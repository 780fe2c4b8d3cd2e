// SPDX-License-Identifier: GPL-3.0-or-later

// A disk that records all requests and can be made to fail: it replaces SQLite's default VFS and
// allocator in the program `campaign_faulty`, which otherwise is `campaign`. Environment variables
// control it in all processes of a run:
//
//   HAFF_TRACE=FILE                     append all writes, truncations, syncs, creations, deletions
//   HAFF_FAIL=KIND:N:ERRNO:once|ever    let the N-th call of a kind fail in each process;
//                                       kinds: read, write, sync, truncate, open, delete, allocate
//   HAFF_FAIL_IN=main|worker            only in these processes
//   HAFF_FAILED=FILE                    made when a call has failed on purpose
//   HAFF_CLOCK=SECONDS                  SQLite's wall clock is this much ahead
//
// All processes share one record, in the order of events (trace.hpp).
#include <fcntl.h>
#include <sqlite3.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>

#include "schema/file/passing_file.hpp"
#include "trace.hpp"

namespace haff::tests {
namespace {

// ---- failures ---------------------------------------------------------------------------------

struct Order {
  std::string kind;
  long number = 0;
  int error = 0;
  bool for_ever = false;
  std::string mark;
};

bool is_worker() {
  std::ifstream words("/proc/self/cmdline", std::ios::binary);
  for (std::string word; std::getline(words, word, '\0');)
    if (word == "worker") return true;
  return false;
}

Order order_from_environment() {
  const char* text = std::getenv("HAFF_FAIL");
  if (text == nullptr) return {};
  const char* where = std::getenv("HAFF_FAIL_IN");
  if (where != nullptr && is_worker() != (std::string(where) == "worker")) return {};
  std::istringstream words(text);
  Order order;
  std::string number, error, how;
  std::getline(words, order.kind, ':');
  std::getline(words, number, ':');
  std::getline(words, error, ':');
  std::getline(words, how, ':');
  order.number = std::stol(number);
  order.error = std::stoi(error);
  order.for_ever = how == "ever";
  const char* mark = std::getenv("HAFF_FAILED");
  order.mark = mark != nullptr ? mark : "";
  return order;
}

const Order& order() {
  static const Order read = order_from_environment();
  return read;
}

// Whether this call of a kind is to fail; sets errno.
bool fails(const char* kind) {
  static thread_local bool is_asking = false;
  if (is_asking) return false;  // this code allocates as well
  is_asking = true;
  static long count = 0;
  bool does = false;
  if (order().kind == kind) {
    ++count;
    does = count == order().number || (order().for_ever && count > order().number);
    if (does && count == order().number) {
      const int made = ::open(order().mark.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644);
      if (made >= 0) ::close(made);
    }
  }
  is_asking = false;
  if (does) errno = order().error;
  return does;
}

// ---- the record -------------------------------------------------------------------------------

void record(Event event, TracedFile file, sqlite3_int64 offset = 0, const void* data = nullptr,
            int size = 0) {
  static const int trace = [] {
    const char* name = std::getenv("HAFF_TRACE");
    return name == nullptr ? -1 : ::open(name, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  }();
  if (trace < 0 || file == TracedFile::none) return;
  TraceHeader header{.event = event,
                     .file = file,
                     .size = static_cast<std::uint32_t>(size),
                     .offset = static_cast<std::uint64_t>(offset)};
  const std::array<iovec, 2> parts{iovec{&header, sizeof header},
                                   iovec{const_cast<void*>(data), static_cast<std::size_t>(size)}};
  if (writev(trace, parts.data(), size > 0 ? 2 : 1) < 0) std::abort();
}

// ---- the VFS ----------------------------------------------------------------------------------

struct File {
  sqlite3_file base;
  TracedFile which;
  int error;  // of the last call that failed on purpose, or 0
};

sqlite3_vfs* system_below = nullptr;

File* own(sqlite3_file* file) {
  return schema::own<File>(file);
}

sqlite3_file* below(sqlite3_file* file) {
  return schema::below<File>(file);
}

bool fails(const char* kind, sqlite3_file* file) {
  const bool does = fails(kind);
  own(file)->error = does ? errno : 0;
  return does;
}

// SQLite's own VFS reports EIO as a corrupt file system.
int read(sqlite3_file* file, void* to, int size, sqlite3_int64 offset) {
  if (fails("read", file)) return order().error == EIO ? SQLITE_IOERR_CORRUPTFS : SQLITE_IOERR_READ;
  return below(file)->pMethods->xRead(below(file), to, size, offset);
}

int write(sqlite3_file* file, const void* from, int size, sqlite3_int64 offset) {
  if (fails("write", file)) return order().error == ENOSPC ? SQLITE_FULL : SQLITE_IOERR_WRITE;
  const int result = below(file)->pMethods->xWrite(below(file), from, size, offset);
  if (result == SQLITE_OK) record(Event::write, own(file)->which, offset, from, size);
  return result;
}

int truncate(sqlite3_file* file, sqlite3_int64 size) {
  if (fails("truncate", file)) return SQLITE_IOERR_TRUNCATE;
  const int result = below(file)->pMethods->xTruncate(below(file), size);
  if (result == SQLITE_OK) record(Event::truncate, own(file)->which, size);
  return result;
}

int sync(sqlite3_file* file, int flags) {
  if (fails("sync", file)) return SQLITE_IOERR_FSYNC;
  const int result = below(file)->pMethods->xSync(below(file), flags);
  if (result == SQLITE_OK) record(Event::sync, own(file)->which);
  return result;
}

int control(sqlite3_file* file, int what, void* argument) {
  if (what == SQLITE_FCNTL_LAST_ERRNO && own(file)->error != 0) {
    *static_cast<int*>(argument) = own(file)->error;
    return SQLITE_OK;
  }
  return below(file)->pMethods->xFileControl(below(file), what, argument);
}
constexpr sqlite3_io_methods methods = [] {
  sqlite3_io_methods ours = schema::passing_methods<File>();
  ours.xRead = read;
  ours.xWrite = write;
  ours.xTruncate = truncate;
  ours.xSync = sync;
  ours.xFileControl = control;
  return ours;
}();

TracedFile traced(int flags) {
  if ((flags & SQLITE_OPEN_MAIN_DB) != 0) return TracedFile::store;
  if ((flags & SQLITE_OPEN_WAL) != 0) return TracedFile::log;
  if ((flags & SQLITE_OPEN_MAIN_JOURNAL) != 0) return TracedFile::journal;
  return TracedFile::none;
}

int open(sqlite3_vfs*, const char* name, sqlite3_file* file, int flags, int* out_flags) {
  file->pMethods = nullptr;
  own(file)->which = traced(flags);
  own(file)->error = 0;
  if (fails("open")) return SQLITE_CANTOPEN;
  const bool is_new = name != nullptr && access(name, F_OK) != 0;
  const int result = system_below->xOpen(system_below, name, below(file), flags, out_flags);
  if (result != SQLITE_OK) return result;
  if (is_new) record(Event::make, own(file)->which);
  file->pMethods = &methods;
  return SQLITE_OK;
}

int remove(sqlite3_vfs*, const char* name, int sync_folder) {
  if (fails("delete")) return SQLITE_IOERR_DELETE;
  const int result = system_below->xDelete(system_below, name, sync_folder);
  const std::string text = name;
  if (result == SQLITE_OK)
    record(sync_folder != 0 ? Event::remove_and_sync : Event::remove,
           text.ends_with("-wal") ? TracedFile::log : TracedFile::journal);
  return result;
}

// ---- the clock --------------------------------------------------------------------------------

// [ms since the beginning of the Julian calendar]
int now(sqlite3_vfs*, sqlite3_int64* time) {
  static const sqlite3_int64 ahead = [] {
    const char* seconds = std::getenv("HAFF_CLOCK");
    return seconds == nullptr ? 0 : 1000 * std::strtoll(seconds, nullptr, 10);
  }();
  const int result = system_below->xCurrentTimeInt64(system_below, time);
  *time += ahead;
  return result;
}

// ---- memory -----------------------------------------------------------------------------------

sqlite3_mem_methods system_memory{};

void* allocate(int size) {
  return fails("allocate") ? nullptr : system_memory.xMalloc(size);
}
void* reallocate(void* old, int size) {
  return fails("allocate") ? nullptr : system_memory.xRealloc(old, size);
}

// Runs before main(), and before SQLite is used.
const bool installed = [] {
  sqlite3_config(SQLITE_CONFIG_GETMALLOC, &system_memory);
  sqlite3_mem_methods memory = system_memory;
  memory.xMalloc = allocate;
  memory.xRealloc = reallocate;
  sqlite3_config(SQLITE_CONFIG_MALLOC, &memory);
  system_below = sqlite3_vfs_find(nullptr);
  static sqlite3_vfs vfs = *system_below;
  vfs.zName = "faulty";
  vfs.pNext = nullptr;
  vfs.szOsFile += static_cast<int>(sizeof(File));
  vfs.xOpen = open;
  vfs.xDelete = remove;
  vfs.xCurrentTimeInt64 = now;
  return sqlite3_vfs_register(&vfs, 1) == SQLITE_OK;
}();

}  // namespace
}  // namespace haff::tests
