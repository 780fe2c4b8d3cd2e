// SPDX-License-Identifier: GPL-3.0-or-later

// The words that are said to Slurm, and its answers.
//
// A round of `campaign submit` is an array of tasks, one for each shard, and a job that begins when
// all of them have ended, in whatever way (--dependency=afterany): it merges the shards and, if
// work is left, submits the next round.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace haff::campaign {

// What a user asks of the cluster; the same in every round.
struct ClusterOptions {
  std::filesystem::path store;              // absolute
  std::filesystem::path folder;             // of shards, scripts and logs; absolute
  std::size_t tasks = 1;                    // at most
  int cpus = 1;                             // of a task: its workers
  double seconds = 0;                       // wall clock of a task
  double put_back_every = 0;                // how often a task saves its shard [s]
  int rounds = 1;                           // at most, the one to be submitted among them
  std::vector<std::string> sbatch_options;  // what else sbatch is given
};

// One round, as it was submitted: the record folder/round-001.json.
struct Round {
  int number = 1;
  std::vector<std::filesystem::path> shards;  // task k works on the k-th, from 1
  std::string tasks_job, merge_job;           // Slurm's numbers; empty before it gave them
};

// How long before its end a task stops computing, to store its work and put its shard back. [s]
double reserve(const ClusterOptions& options);

// The path of this program, which a task on another machine starts as well.
std::string this_program();

// The words as a shell needs them.
std::string shell_line(const std::vector<std::string>& words);

// What the user types to submit with these options.
std::string submit_line(const ClusterOptions& options);

// The scripts of the tasks and of the job after them, as they are given to sbatch.
std::string tasks_script(const ClusterOptions& options, const Round& round);
std::string merge_script(const ClusterOptions& options, const Round& round);

// The command lines of sbatch, word by word. The second one needs the number of the tasks' job.
std::vector<std::string> tasks_command(const ClusterOptions& options, const Round& round);
std::vector<std::string> merge_command(const ClusterOptions& options, const Round& round);

// Where files of a round are: folder/round-001.json, .tasks.sh, .merge.sh, .shards.
std::filesystem::path round_file(const std::filesystem::path& folder, int round,
                                 const std::string& suffix);

// Keeps and finds the records of rounds. A record that cannot be read is left out.
void write_record(const std::filesystem::path& folder, const Round& round);
std::vector<Round> read_records(const std::filesystem::path& folder);

// The numbers of this user's jobs that are pending, running or just ending. Throws
// std::runtime_error if squeue does not answer.
std::set<std::string> jobs_in_queue();

// What squeue says of each task of the rounds, by shard: "RUNNING on n1 for 1:23:45". Empty where
// there is no squeue, or the tasks have ended.
std::map<std::filesystem::path, std::string> slurm_states(const std::vector<Round>& rounds);

}  // namespace haff::campaign
