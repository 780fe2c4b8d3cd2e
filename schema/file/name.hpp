// SPDX-License-Identifier: GPL-3.0-or-later

// The name of a store is always a path to one file, whatever else SQLite would take it for.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>

namespace haff::schema {

// The absolute path behind a name, links followed: SQLite keeps its logs beside the file, not
// beside a link to it. Throws NameError for what can be no store: "", a folder, a pipe, a device, a
// link to nothing, a name in a folder that is not there. The file itself need not exist.
std::filesystem::path resolved(const std::filesystem::path& name);

// Throws NameError if there is no file.
void must_exist(const std::filesystem::path& name, const std::filesystem::path& file);

// Throws StoreError if the file has a second name (hard link): each name would get a log of its
// own, and what is written through one would be missing or worse in the other.
void must_have_one_name(const std::filesystem::path& name, const std::filesystem::path& file);

// Makes an empty file with the permissions that the umask leaves, unless there is one. SQLite alone
// would make it 0644, and its logs like it, so that a group could not share a store.
void make(const std::filesystem::path& name, const std::filesystem::path& file);

// Which file a path leads to now; nothing if to none.
struct FileIdentity {
  dev_t device = 0;
  ino_t inode = 0;

  bool operator==(const FileIdentity&) const = default;
};
std::optional<FileIdentity> identity_of(const std::filesystem::path& file);

// The store's log or rollback journal, a file beside it.
std::filesystem::path beside(const std::filesystem::path& file, const char* suffix);

// May this process write the file, and make others beside it?
bool may_write(const std::filesystem::path& file);

}  // namespace haff::schema
