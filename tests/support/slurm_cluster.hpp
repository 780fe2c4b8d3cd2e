// SPDX-License-Identifier: GPL-3.0-or-later

// A cluster of this one machine: munged, slurmctld and two slurmd of Debian's packages slurm-wlm
// and munge, all in a folder of the test's own and gone with it. Nothing is read or written
// elsewhere: SLURM_CONF in the environment of this process names the cluster to all that it starts.
#pragma once

#include <sys/types.h>

#include <array>
#include <filesystem>
#include <string>

namespace haff::tests {

class SlurmCluster {
 public:
  // Starts it and waits until both nodes are idle. Otherwise the test fails and shows the logs.
  explicit SlurmCluster(const std::filesystem::path& folder);
  ~SlurmCluster();
  SlurmCluster(const SlurmCluster&) = delete;
  SlurmCluster& operator=(const SlurmCluster&) = delete;

  // The names of the nodes.
  static constexpr std::array<const char*, 2> nodes{"n1", "n2"};

  // The process of a node's slurmd.
  pid_t daemon(const std::string& node) const;
  void start_daemon(const std::string& node) const;

  // Runs a command of Slurm with the shell; its output. Fails the test if the command fails.
  std::string slurm(const std::string& command) const;

  // Waits until the queue holds no job of this user; fails the test after so many seconds.
  void wait_until_empty(int seconds) const;

 private:
  pid_t process(const std::string& pid_file) const;
  std::string logs() const;

  std::filesystem::path folder_;
};

}  // namespace haff::tests
