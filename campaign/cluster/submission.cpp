// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/cluster/submission.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <set>
#include <stdexcept>
#include <thread>

#include "campaign/base/output/write_file.hpp"
#include "campaign/base/text/command_text.hpp"
#include "campaign/cluster/subprocess.hpp"

namespace haff::campaign {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

// The number that sbatch gives a job: "123", or "123;cluster". A controller that is busy, or is
// just restarting, may refuse a job that it accepts a minute later.
std::string submitted(const std::vector<std::string>& words, std::chrono::seconds patience) {
  const auto until = std::chrono::steady_clock::now() + patience;
  for (std::chrono::seconds pause = 1s;; pause = std::min(2 * pause, std::chrono::seconds(60))) {
    const auto answer = ask(words);
    if (answer && answer->exit_code == 0)
      return answer->out.substr(0, answer->out.find_first_of(";\n"));
    if (std::chrono::steady_clock::now() + pause > until)
      throw std::runtime_error("sbatch refused this: " + shell_line(words));
    std::this_thread::sleep_for(pause);
  }
}

std::string own_job() {
  const char* number = std::getenv("SLURM_JOB_ID");
  return number != nullptr ? number : "";
}

}  // namespace

SubmissionLock::SubmissionLock(const fs::path& folder) {
  fs::create_directories(folder);
  const fs::path path = folder / "submit.lock";
  file_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (file_ < 0) throw std::runtime_error(path.string() + ": cannot be made; may it be written?");
  // Where the file system knows no such locks, a lock file of the store stands in (host_lock.hpp).
  if (flock(file_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  close(file_);
  throw std::runtime_error(folder.string() +
                           ": another campaign submit is at work on it; give the same command "
                           "again when it has ended");
}

SubmissionLock::~SubmissionLock() {
  close(file_);
}

std::vector<OpenRound> open_rounds(const schema::Reader& store, const fs::path& folder,
                                   std::optional<int> ended) {
  const auto shards = store.shards();
  std::optional<std::set<std::string>> queue;
  const auto is_in_queue = [&](const std::string& job) {
    if (job.empty()) return false;
    if (!queue) queue = jobs_in_queue();
    return queue->contains(job);
  };
  std::vector<OpenRound> open;
  for (const Round& round : read_records(folder)) {
    OpenRound each{.round = round, .shards = {}};
    for (const schema::Shard& shard : shards)
      if (!shard.returned && std::ranges::find(round.shards, shard.path) != round.shards.end())
        each.shards.push_back(shard);
    if (each.shards.empty()) continue;
    if (round.number != ended) {
      each.has_tasks = is_in_queue(round.tasks_job);
      each.has_merge = round.merge_job != own_job() && is_in_queue(round.merge_job);
    }
    open.push_back(std::move(each));
  }
  return open;
}

void enqueue(const ClusterOptions& options, Round& round, std::chrono::seconds patience) {
  std::string list;
  for (const fs::path& shard : round.shards) list += shard.string() + '\n';
  write_file(round_file(options.folder, round.number, ".shards"), list);
  write_file(round_file(options.folder, round.number, ".tasks.sh"), tasks_script(options, round));
  write_record(options.folder, round);
  round.tasks_job = submitted(tasks_command(options, round), patience);
  try {
    write_record(options.folder, round);
    enqueue_merge(options, round, patience);
  } catch (...) {
    ask({"scancel", round.tasks_job});
    throw;
  }
}

void enqueue_merge(const ClusterOptions& options, Round& round, std::chrono::seconds patience) {
  write_file(round_file(options.folder, round.number, ".merge.sh"), merge_script(options, round));
  round.merge_job = submitted(merge_command(options, round), patience);
  write_record(options.folder, round);
}

}  // namespace haff::campaign
