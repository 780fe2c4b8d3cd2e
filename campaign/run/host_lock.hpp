// SPDX-License-Identifier: GPL-3.0-or-later

// One host at a time for a store on a network file system.
//
// SQLite's write-ahead log needs memory that all users share, which several hosts do not have, and
// the locks of network file systems cannot be relied on. So a command that opens such a store
// leaves a file beside it, STORE.host, that says which host uses it, by which process and since
// when. Commands of another host wait for a moment and are then refused. Commands of the same host
// share the store as on a local disk, since SQLite's own locks hold between processes of one host.
// The file belongs to the process whose use matters most: a run, else a command that writes, else a
// reader. Other hosts wait for a reader for a moment only, since it may have been killed. A reader
// does no harm: it is told at its end that the store was written meanwhile.
#pragma once

#include <chrono>
#include <filesystem>

#include "schema/store/store.hpp"

namespace haff::campaign {

// What a process does with a store. A command that writes is over in seconds, a run takes hours.
enum class Use { read, write, run };

class HostLock {
 public:
  // How long to wait for another user: most commands take seconds.
  static constexpr std::chrono::milliseconds usual_patience{10'000};
  // The same where no user is there to give the command again.
  static constexpr std::chrono::milliseconds unattended_patience{600'000};

  // Takes the lock for this process, unless the store is on a local disk. A reader that cannot
  // write beside the store goes without a lock. Throws schema::Locked if another host has the lock,
  // or a command of this host that must not be disturbed.
  HostLock(const std::filesystem::path& store, Use use,
           std::chrono::milliseconds patience = usual_patience);
  // The same, where the caller says whether the store is on a network file system.
  HostLock(const std::filesystem::path& store, Use use, bool is_on_network, const schema::Owner& me,
           std::chrono::milliseconds patience);
  ~HostLock();
  HostLock(const HostLock&) = delete;
  HostLock& operator=(const HostLock&) = delete;

 private:
  enum class Taken { yes, no, impossible };
  Taken take() const;

  std::filesystem::path file_;
  Use use_;
  schema::Owner me_;
  bool is_ours_ = false;
};

}  // namespace haff::campaign
