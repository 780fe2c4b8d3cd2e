// SPDX-License-Identifier: GPL-3.0-or-later

// SQLite's way to the disk, with three things of our own in between ("VFS" in its documentation).
//
//  * What failed is remembered, so that a message can name the file, the operation and the system's
//    reason: a full temporary folder is not a full disk, nor are too many open files.
//  * A read that fails is an error of reading. SQLite's own layer takes EIO for a corrupt file
//    system, and reports it as a damaged database: one bad read would condemn a sound store.
//  * Only the store's own files are deleted. The rollback journal of a transaction over several
//    databases names a further file, the super-journal, which SQLite deletes after the rollback. A
//    store is always alone: this program writes no journal that names such a file, and the file is
//    not the store's. It is neither opened nor deleted.
//
// All else is left to the VFS that was SQLite's default when the first store was opened.
#pragma once

#include <optional>
#include <string>

namespace haff::schema {

enum class Operation { open, read, write, sync, truncate, remove, lock, map };

struct Trouble {
  Operation operation = Operation::read;
  std::string file;              // its path; empty: a temporary file of SQLite
  int error = 0;                 // errno
  bool foreign_journal = false;  // a rollback journal names a file that is not the store's
};

// The name of the VFS, registered by the first call. `observer`: the one of a process that may not
// write the store. It makes no file beside it, for the owner could not delete that again.
const char* file_system();
const char* observer_file_system();

// The last operation of this thread that failed since forget_trouble().
std::optional<Trouble> last_trouble();
void forget_trouble();

// The folder in which SQLite makes its temporary files.
std::string temporary_folder();

}  // namespace haff::schema
