// SPDX-License-Identifier: GPL-3.0-or-later

#include "support/slurm_cluster.hpp"

#include <doctest/doctest.h>
#include <pwd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <random>
#include <thread>

namespace haff::tests {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string host_name() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

// The output of a shell command, and its exit code.
std::pair<std::string, int> shell_output(const std::string& command) {
  std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return {"", -1};
  std::string text;
  std::array<char, 4096> buffer{};
  while (const std::size_t size = std::fread(buffer.data(), 1, buffer.size(), pipe))
    text.append(buffer.data(), size);
  const int status = pclose(pipe);
  return {text, WIFEXITED(status) ? WEXITSTATUS(status) : -1};
}

bool within(std::chrono::seconds time, const auto& condition) {
  const auto until = std::chrono::steady_clock::now() + time;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > until) return false;
    std::this_thread::sleep_for(100ms);
  }
  return true;
}

// Ports of this process, so that two clusters at a time do not meet.
int port(int number) {
  return 20000 + static_cast<int>(getpid() % 4000) * 8 + number;
}

}  // namespace

SlurmCluster::SlurmCluster(const fs::path& folder) : folder_(folder) {
  fs::create_directories(folder);
  fs::permissions(folder, fs::perms::owner_all | fs::perms::group_read | fs::perms::group_exec |
                              fs::perms::others_read | fs::perms::others_exec);
  const std::string place = folder.string(), host = host_name();
  const std::string user = getpwuid(getuid())->pw_name;
  {
    std::ofstream key(folder / "munge.key", std::ios::binary);
    std::random_device random;
    for (int i = 0; i < 1024; ++i) key.put(static_cast<char>(random()));
  }
  fs::permissions(folder / "munge.key", fs::perms::owner_read | fs::perms::owner_write);
  std::ofstream(folder / "slurm.conf")
      << "ClusterName=test\nSlurmctldHost=" << host << "(127.0.0.1)\nSlurmUser=" << user
      << "\nSlurmdUser=" << user << "\nAuthType=auth/munge\nAuthInfo=socket=" << place
      << "/munge.socket\nCredType=cred/munge\nStateSaveLocation=" << place
      << "/state\nSlurmdSpoolDir=" << place << "/spool-%n\nSlurmctldPidFile=" << place
      << "/slurmctld.pid\nSlurmdPidFile=" << place << "/slurmd-%n.pid\nSlurmctldLogFile=" << place
      << "/slurmctld.log\nSlurmdLogFile=" << place << "/slurmd-%n.log\nSlurmctldPort=" << port(0)
      << R"(
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SchedulerType=sched/backfill
SchedulerParameters=bf_interval=1,sched_interval=2,batch_sched_delay=0
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
SlurmdTimeout=10
KillWait=2
MpiDefault=none
PreemptType=preempt/partition_prio
PreemptMode=REQUEUE
)";
  std::ofstream conf(folder / "slurm.conf", std::ios::app);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    conf << "NodeName=" << nodes[i] << " NodeHostname=" << host
         << " NodeAddr=127.0.0.1 Port=" << port(1 + static_cast<int>(i))
         << " CPUs=2 RealMemory=1000\n";
  conf << "PartitionName=all Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP PriorityTier=1\n"
          "PartitionName=urgent Nodes=n1,n2 MaxTime=INFINITE State=UP PriorityTier=2\n";
  conf.close();
  for (const char* name : {"state", "spool-n1", "spool-n2"}) fs::create_directories(folder / name);
  setenv("SLURM_CONF", (folder / "slurm.conf").c_str(), 1);

  const auto start = [&](const std::string& command) {
    const auto result = shell_output(command);
    REQUIRE_MESSAGE(
        result.second == 0,
        command << ": " << result.first << " (Debian's packages slurm-wlm and munge are needed)");
  };
  start("PATH=$PATH:/usr/sbin munged --force --key-file=" + place + "/munge.key --socket=" + place +
        "/munge.socket --pid-file=" + place + "/munged.pid --log-file=" + place +
        "/munged.log --seed-file=" + place + "/munged.seed");
  start("PATH=$PATH:/usr/sbin slurmctld -c");
  for (const char* node : nodes) start_daemon(node);
  const bool idle = within(60s, [] {
    return shell_output("sinfo --noheader --format='%T %D' --partition=all").first == "idle 2\n";
  });
  REQUIRE_MESSAGE(idle, "the nodes are not idle within a minute:\n" << logs());
}

SlurmCluster::~SlurmCluster() {
  shell_output("scancel --user=" + std::to_string(getuid()));
  for (const char* file : {"slurmd-n1.pid", "slurmd-n2.pid", "slurmctld.pid", "munged.pid"})
    if (const pid_t id = process(file); id > 0) {
      kill(id, SIGTERM);
      if (!within(10s, [&] { return kill(id, 0) != 0; })) kill(id, SIGKILL);
    }
}

pid_t SlurmCluster::process(const std::string& pid_file) const {
  const std::string text = text_of(folder_ / pid_file);
  return text.empty() ? 0 : std::stoi(text);
}

pid_t SlurmCluster::daemon(const std::string& node) const {
  return process("slurmd-" + node + ".pid");
}

void SlurmCluster::start_daemon(const std::string& node) const {
  const auto result = shell_output("PATH=$PATH:/usr/sbin slurmd -N " + node);
  REQUIRE_MESSAGE(result.second == 0, "slurmd of " << node << ": " << result.first);
}

std::string SlurmCluster::slurm(const std::string& command) const {
  auto result = shell_output(command);
  REQUIRE_MESSAGE(result.second == 0, command << ": " << result.first);
  return std::move(result.first);
}

void SlurmCluster::wait_until_empty(int seconds) const {
  const bool empty = within(std::chrono::seconds(seconds),
                            [&] { return shell_output("squeue --noheader --me").first.empty(); });
  REQUIRE_MESSAGE(empty, "jobs are left:\n" << shell_output("squeue").first << logs());
}

std::string SlurmCluster::logs() const {
  return shell_output("tail -n 20 " + folder_.string() + "/*.log").first;
}

}  // namespace haff::tests
