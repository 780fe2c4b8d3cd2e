// One host at a time for a store on a network file system.
//
// SQLite's write-ahead log needs memory that all users share, which hosts do not have, and the
// locks of network file systems are not to be relied on for more than politeness. So a command that
// may write such a store leaves a file beside it, STORE.host, that says which host uses it, by
// which process and since when. Commands of the same host share the store while a run is on, as on
// a local disk; those of another host wait for a moment and are then refused.
#pragma once

#include <chrono>
#include <filesystem>

#include "schema/store.hpp"

namespace haff::campaign {

class HostLock {
 public:
  // How long to wait for another user: a merge on a node of a cluster takes seconds.
  static constexpr std::chrono::seconds usual_patience{10};

  // Takes the lock for this process, unless the store is on a local disk. `is_run`: other commands
  // of this host may use the store meanwhile. Throws schema::Locked if another host has it.
  HostLock(const std::filesystem::path& store, bool is_run);
  // The same, for a store that is on a network file system or not as it is said.
  HostLock(const std::filesystem::path& store, bool is_run, bool is_on_network,
           const schema::Owner& me, std::chrono::milliseconds patience);
  ~HostLock();
  HostLock(const HostLock&) = delete;
  HostLock& operator=(const HostLock&) = delete;

 private:
  bool take(const schema::Owner& me, bool is_run) const;

  std::filesystem::path file_;
  bool is_ours_ = false;
};

}  // namespace haff::campaign
