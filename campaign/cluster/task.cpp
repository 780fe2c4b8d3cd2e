// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/cluster/task.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <sys/file.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "campaign/base/process/signals.hpp"
#include "campaign/base/text/error_text.hpp"
#include "schema/file/flush.hpp"
#include "schema/store/store.hpp"

namespace haff::campaign {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto look_every = 100ms;

// A folder of the task's own on a disk of its node, removed at its end. A task that is killed
// cannot remove its folder: the next one on this node does. A lock on a file in each folder, which
// the kernel lifts when a task dies in whatever way, tells which folders are left over.
class Scratch {
 public:
  Scratch() {
    for (const char* variable : {"SLURM_TMPDIR", "TMPDIR"})
      if (const char* folder = std::getenv(variable); folder != nullptr && make_in(folder)) return;
    if (!make_in("/tmp"))
      throw std::runtime_error(
          "no scratch folder can be made in $SLURM_TMPDIR, $TMPDIR or /tmp; set TMPDIR to a folder "
          "on a disk of the node");
  }
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    close(lock_);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  const fs::path& path() const { return path_; }

  // Moves what is here to a folder that no task removes, and returns that.
  fs::path keep() const {
    fs::path kept = path_.parent_path() / ("kept-" + path_.filename().string());
    fs::remove(path_ / lock_name);
    fs::rename(path_, kept);
    return kept;
  }

 private:
  static constexpr const char* prefix = "campaign-";
  static constexpr const char* lock_name = "in-use";

  bool make_in(const fs::path& folder) {
    remove_left_over(folder);
    std::string name = (folder / (std::string(prefix) + "XXXXXX")).string();
    if (mkdtemp(name.data()) == nullptr) return false;
    path_ = name;
    // The lock is taken before the file has the name that others look for. The run inherits it,
    // since it may be a moment longer at work than a task that is killed.
    const fs::path unnamed = path_ / "new";
    lock_ = open(unnamed.c_str(), O_RDWR | O_CREAT, 0600);
    if (lock_ >= 0) flock(lock_, LOCK_EX | LOCK_NB);
    std::error_code ignored;
    fs::rename(unnamed, path_ / lock_name, ignored);
    return true;
  }

  static void remove_left_over(const fs::path& parent) {
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(parent, ignored)) {
      if (!entry.path().filename().string().starts_with(prefix) || !is_mine(entry.path())) continue;
      const int lock = open((entry.path() / lock_name).c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW);
      if (lock < 0) continue;
      if (flock(lock, LOCK_EX | LOCK_NB) == 0) fs::remove_all(entry.path(), ignored);
      close(lock);
    }
  }

  static bool is_mine(const fs::path& folder) {
    struct stat about {};
    return lstat(folder.c_str(), &about) == 0 && S_ISDIR(about.st_mode) &&
           about.st_uid == geteuid();
  }

  fs::path path_;
  int lock_ = -1;
};

// A name of this process, unlike that of any other on any host at any time.
std::string signature() {
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  return fmt::format("{} process {} since {}", host.data(), getpid(),
                     std::chrono::system_clock::now().time_since_epoch().count());
}

// Says which task works on a shard. A task that was requeued may still live on a node that was cut
// off: the newer one takes over, and the older one must not put an older state back.
class Claimed {
 public:
  explicit Claimed(const fs::path& shard) : file_(shard.string() + ".task"), mine_(signature()) {
    std::ofstream(file_) << mine_ << '\n';
    if (!still())
      throw std::runtime_error(file_.string() + ": cannot be written; is the disk full?");
  }
  ~Claimed() {
    std::error_code ignored;
    if (still()) fs::remove(file_, ignored);
  }
  Claimed(const Claimed&) = delete;
  Claimed& operator=(const Claimed&) = delete;

  // The file is gone when another task, or a merge, has ended meanwhile. An error of the system
  // says nothing about it.
  bool still() const {
    std::error_code unknown;
    if (!fs::exists(file_, unknown)) return static_cast<bool>(unknown);
    std::ifstream file(file_);
    std::string line;
    std::getline(file, line);
    return line == mine_;
  }

 private:
  fs::path file_;
  std::string mine_;
};

// Puts the shard, as it is at this moment, in place of the one in the user's folder, unless another
// task has claimed that one meanwhile. Returns whether it was put back.
bool put_back(const fs::path& working, const fs::path& shard, const Claimed& claimed) {
  const fs::path part = fmt::format("{}.part-{}", shard.string(), getpid());
  std::error_code ignored;
  fs::remove(part, ignored);
  try {
    schema::Reader(working).back_up(part);
    const bool is_still_ours = claimed.still();
    if (is_still_ours) fs::rename(part, shard);
    fs::remove(part, ignored);
    schema::flush_to_disk(shard.parent_path());
    return is_still_ours;
  } catch (...) {
    fs::remove(part, ignored);
    throw;
  }
}

// The shard, on the disk of the node.
void copy_to_node(const fs::path& shard, const fs::path& working) {
  std::error_code error;
  fs::copy_file(shard, working, error);
  if (error)
    throw std::runtime_error(fmt::format(
        "{}: cannot be copied to {} ({}); set TMPDIR to a folder with room on a disk of the node",
        shard.string(), working.parent_path().string(), error.message()));
}

// Brings a shard of an older program forward. No other process knows of the copy, so that none
// holds the leases in it.
void bring_forward(const fs::path& working) {
  std::vector<schema::Lease> leases;
  for (const schema::RunningJob& job : schema::Reader(working).running())
    leases.push_back(job.lease);
  schema::Store::upgrade(working, leases);
}

// `campaign run` on the copy: the same program, as a child that dies with this process.
pid_t start_run(const fs::path& store, const TaskOptions& options) {
  std::vector<std::string> words{"campaign",     "run",       "--store",
                                 store.string(), "--workers", std::to_string(options.workers)};
  if (options.max_seconds) {
    words.emplace_back("--max-time");
    words.push_back(fmt::format("{:.0f}s", *options.max_seconds));
  }
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const pid_t parent = getpid();
  const pid_t id = fork();
  if (id < 0)
    throw std::runtime_error(fmt::format("cannot start the run: {}", std::strerror(errno)));
  if (id > 0) return id;
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(1);
  // Its last lines on stdout are about the copy, which is gone by then.
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  dup2(nowhere, STDOUT_FILENO);
  execv("/proc/self/exe", arguments.data());
  _exit(127);
}

class Task {
 public:
  explicit Task(const TaskOptions& options)
      : options_(options),
        shard_(fs::absolute(options.shard)),
        claimed_(shard_),
        working_(scratch_.path() / "shard.db") {}

  int work() {
    copy_to_node(shard_, working_);
    bring_forward(working_);
    spdlog::info("{} is worked on in {}", shard_.string(), scratch_.path().string());
    const int exit_code = run();
    try {
      if (is_lost()) return exit_code;
      if (put_back(working_, shard_, claimed_)) spdlog::info("{} is put back", shard_.string());
    } catch (const std::exception&) {
      spdlog::error("what was computed is in {}, until the node clears it",
                    (scratch_.keep() / working_.filename()).string());
      throw;
    }
    return exit_code;
  }

 private:
  // Waits for the run; passes signals on and puts the shard back from time to time.
  int run() {
    const pid_t id = start_run(working_, options_);
    auto put_back_at = Clock::now();
    int signals_passed = 0;
    int status = 0;
    for (;;) {
      const pid_t ended = waitpid(id, &status, WNOHANG);
      if (ended == id || (ended < 0 && errno == ECHILD)) break;
      for (; signals_passed < stop_signals(); ++signals_passed) kill(id, SIGTERM);
      const std::chrono::duration<double> since = Clock::now() - put_back_at;
      if (signals_passed == 0 && since.count() > options_.put_back_every) {
        put_back_meanwhile(id);
        put_back_at = Clock::now();
      }
      std::this_thread::sleep_for(look_every);
    }
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  }

  // A copy that fails costs nothing yet: the next one may succeed.
  void put_back_meanwhile(pid_t run) {
    if (is_lost()) {
      kill(run, SIGTERM);
      return;
    }
    try {
      put_back(working_, shard_, claimed_);
    } catch (const std::exception& error) {
      spdlog::warn("{} could not be put back: {}", shard_.string(), error_text(error));
    }
  }

  // Whether another task has the shard now.
  bool is_lost() const {
    if (claimed_.still()) return false;
    spdlog::warn(
        "{}: another task has begun to work on it; this one stops, and what it did since "
        "it last put the shard back is lost",
        shard_.string());
    return true;
  }

  const TaskOptions& options_;
  fs::path shard_;
  Claimed claimed_;
  Scratch scratch_;
  fs::path working_;
};

}  // namespace

int work_on_shard(const TaskOptions& options) {
  note_stop_signals();
  if (!fs::exists(options.shard))
    throw std::runtime_error(options.shard.string() +
                             ": there is no such shard; campaign split writes shards");
  return Task(options).work();
}

}  // namespace haff::campaign
