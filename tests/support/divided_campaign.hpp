// SPDX-License-Identifier: GPL-3.0-or-later

// A campaign that is divided among shards or the tasks of a cluster, and checks of what comes home.
#pragma once

#include <chrono>
#include <random>
#include <string>
#include <vector>

#include "cli/program.hpp"

namespace haff::tests {

// Everything that a store can hold of a job: an effect, profiles, fields, and a target whose seeds
// are found in later rounds.
extern const std::string grid_with_everything;

// Some seconds of work in six jobs that store often, for runs that are to be disturbed.
extern const std::string long_grid;

// A grid of a few small gases, with effects, observables and cadences drawn at random.
std::string random_grid(std::mt19937& random);

void plan(const Folder& folder, const std::string& grid);

// The rows of one undisturbed run of the grid.
std::string undisturbed_rows(const std::string& grid);

// `campaign submit` with three tasks of one processor that save their shards each second, and
// further words.
Outcome submit(const Folder& folder, const std::string& time,
               std::vector<std::string> further = {});

// The number of Slurm's job with the tasks of this round.
std::string tasks_job(const Folder& folder, int round);

// Waits until this many tasks of a partition run. Slurm keeps a requeued task for two minutes.
void wait_for_running(const Folder& folder, const std::string& partition, int count);

// Waits until the shard at home holds this many states, since its task has put it back.
void wait_for_states(const Folder& folder, const std::string& shard, int count);

// The same until there is a state of a cooling job that is not done.
void wait_for_cooling(const Folder& folder, const std::string& shard);

// Starts the command and kills it after some milliseconds. Returns whether it still ran then.
bool kill_after(const Folder& folder, std::vector<std::string> words,
                std::chrono::milliseconds time);

// A random campaign, divided, run, killed, merged and recalled at random until nothing is pending
// or lent; checks that its rows are those of one run. Returns how many merges were killed at work.
int run_random_campaign(unsigned seed);

// The ends of the logs of all tasks and merges, for messages.
std::string logs(const Folder& folder);

// Checks that all jobs are done, that the rows are these in every bit, and that the store is sound.
void check_completed(const Folder& folder, const std::string& expected);

// The stretches of tau of cooling jobs that two attempts have both computed and stored, a line
// each, from the logs of the tasks. There are none if only lost work was computed again.
std::string computed_twice(const Folder& folder);

}  // namespace haff::tests
