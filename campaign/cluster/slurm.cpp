// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/cluster/slurm.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "campaign/base/output/write_file.hpp"
#include "campaign/base/text/command_text.hpp"
#include "campaign/cluster/subprocess.hpp"

namespace haff::campaign {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

// A shard is copied home within this part of a task's time, and these bounds. [s]
constexpr double reserved_share = 0.05;
constexpr double least_reserve = 30, most_reserve = 300;
// At most this part of a very short task is reserved.
constexpr double most_reserved_share = 0.25;

// D-HH:MM:SS, as Slurm reads it.
std::string slurm_time(double seconds) {
  const auto whole = static_cast<long long>(std::ceil(seconds));
  return fmt::format("{}-{:02}:{:02}:{:02}", whole / 86400, whole / 3600 % 24, whole / 60 % 60,
                     whole % 60);
}

// As a user types it: 4h, 1h30m.
std::string duration_word(double seconds) {
  auto left = static_cast<long long>(std::ceil(seconds));
  std::string word;
  for (const auto& [unit, length] : {std::pair{'d', 86400}, {'h', 3600}, {'m', 60}, {'s', 1}}) {
    if (left >= length) word += fmt::format("{}{}", left / length, unit);
    left %= length;
  }
  return word;
}

std::vector<std::string> with_options(std::vector<std::string> words, const ClusterOptions& options,
                                      const fs::path& script) {
  words.insert(words.end(), options.sbatch_options.begin(), options.sbatch_options.end());
  words.push_back(script.string());
  return words;
}

// In the file name patterns of sbatch, % has a meaning of its own.
std::string pattern(const fs::path& path) {
  std::string text;
  for (const char c : path.string()) text += c == '%' ? std::string("%%") : std::string(1, c);
  return text;
}

std::string job_name(const ClusterOptions& options) {
  return "campaign-" + options.store.stem().string();
}

}  // namespace

std::string this_program() {
  return fs::read_symlink("/proc/self/exe").string();
}

double reserve(const ClusterOptions& options) {
  return std::min(std::clamp(reserved_share * options.seconds, least_reserve, most_reserve),
                  most_reserved_share * options.seconds);
}

std::string shell_line(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + quoted_word(word);
  return line;
}

std::string submit_line(const ClusterOptions& options) {
  const std::string words =
      fmt::format("submit --tasks {} --cpus {} --time {} --out {}", options.tasks, options.cpus,
                  duration_word(options.seconds), shell_word(options.folder.string()));
  const std::string rest =
      options.sbatch_options.empty() ? "" : " -- " + shell_line(options.sbatch_options);
  return command_text(words, options.store) + rest;
}

std::string tasks_script(const ClusterOptions& options, const Round& round) {
  return fmt::format(
      R"(#!/bin/sh
# Task k works on the shard in line k of the list.
shard=$(sed -n "${{SLURM_ARRAY_TASK_ID}}p" {})
exec {} task --workers "${{SLURM_CPUS_PER_TASK:-{}}}" --max-time {}s --put-back-every {}s -- "$shard"
)",
      shell_word(round_file(options.folder, round.number, ".shards").string()),
      shell_word(this_program()), options.cpus, options.seconds - reserve(options),
      options.put_back_every);
}

std::string merge_script(const ClusterOptions& options, const Round& round) {
  std::string words = fmt::format(
      "submit --store {} --out {} --tasks {} --cpus {} --time {}s --put-back-every {}s "
      "--rounds {} --round {}",
      shell_word(options.store.string()), shell_word(options.folder.string()), options.tasks,
      options.cpus, options.seconds, options.put_back_every, options.rounds - 1, round.number + 1);
  if (!options.sbatch_options.empty()) words += " -- " + shell_line(options.sbatch_options);
  return fmt::format(
      "#!/bin/sh\n# All tasks of round {} have ended: their shards come home, and what is left is "
      "submitted again.\nexec {} {}\n",
      round.number, shell_word(this_program()), words);
}

std::vector<std::string> tasks_command(const ClusterOptions& options, const Round& round) {
  return with_options(
      {"sbatch", "--parsable", "--job-name=" + job_name(options),
       fmt::format("--array=1-{}", round.shards.size()),
       fmt::format("--cpus-per-task={}", options.cpus), "--time=" + slurm_time(options.seconds),
       fmt::format("--signal=B:USR1@{:.0f}", std::max(1.0, reserve(options) / 2)), "--requeue",
       "--open-mode=append",
       "--output=" + pattern(round_file(options.folder, round.number, "")) + "-task-%a.log"},
      options, round_file(options.folder, round.number, ".tasks.sh"));
}

std::vector<std::string> merge_command(const ClusterOptions& options, const Round& round) {
  return with_options(
      {"sbatch", "--parsable", "--job-name=" + job_name(options) + "-merge",
       "--dependency=afterany:" + (round.tasks_job.empty() ? "TASKS" : round.tasks_job),
       "--time=" + slurm_time(options.seconds), "--requeue", "--open-mode=append",
       "--output=" + pattern(round_file(options.folder, round.number, "")) + "-merge.log"},
      options, round_file(options.folder, round.number, ".merge.sh"));
}

fs::path round_file(const fs::path& folder, int round, const std::string& suffix) {
  return folder / fmt::format("round-{:03}{}", round, suffix);
}

void write_record(const fs::path& folder, const Round& round) {
  ordered_json shards = ordered_json::array();
  for (const fs::path& shard : round.shards) shards.push_back(shard.string());
  const ordered_json record{{"round", round.number},
                            {"tasks_job", round.tasks_job},
                            {"merge_job", round.merge_job},
                            {"shards", shards}};
  const fs::path path = round_file(folder, round.number, ".json");
  const fs::path part = path.string() + ".part";
  write_file(part, record.dump(2) + '\n');
  fs::rename(part, path);
}

std::vector<Round> read_records(const fs::path& folder) {
  std::vector<Round> rounds;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) {
    if (entry.path().extension() != ".json") continue;
    std::ifstream file(entry.path());
    const auto record = nlohmann::json::parse(file, nullptr, false);
    if (!record.is_object()) continue;
    try {
      Round round{.number = record.at("round").get<int>(),
                  .shards = {},
                  .tasks_job = record.at("tasks_job").get<std::string>(),
                  .merge_job = record.at("merge_job").get<std::string>()};
      for (const auto& shard : record.at("shards"))
        round.shards.emplace_back(shard.get<std::string>());
      rounds.push_back(std::move(round));
    } catch (const nlohmann::json::exception&) {
      continue;
    }
  }
  std::ranges::sort(rounds, {}, &Round::number);
  return rounds;
}

std::set<std::string> jobs_in_queue() {
  const auto answer = ask({"squeue", "--noheader", "--me", "--format=%F"});
  if (!answer || answer->exit_code != 0)
    throw std::runtime_error(
        "squeue does not say what has become of tasks submitted before; give the same command "
        "again "
        "when it answers");
  std::istringstream lines(answer->out);
  return {std::istream_iterator<std::string>(lines), {}};
}

std::map<fs::path, std::string> slurm_states(const std::vector<Round>& rounds) {
  std::map<std::string, const Round*> by_job;
  for (const Round& round : rounds)
    if (!round.tasks_job.empty()) by_job[round.tasks_job] = &round;
  if (by_job.empty()) return {};
  const auto answer =
      ask({"squeue", "--noheader", "--array", "--me", "--format=%F|%K|%T|%N|%M|%r"});
  std::map<fs::path, std::string> states;
  if (!answer || answer->exit_code != 0) return states;
  std::istringstream lines(answer->out);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    std::string job, task, state, node, time, reason;
    for (std::string* field : {&job, &task, &state, &node, &time, &reason})
      std::getline(fields, *field, '|');
    const auto found = by_job.find(job);
    std::size_t k = 0;
    std::from_chars(task.data(), task.data() + task.size(), k);
    if (found == by_job.end() || k < 1 || k > found->second->shards.size()) continue;
    states[found->second->shards[k - 1]] = node.empty()
                                               ? fmt::format("{} ({})", state, reason)
                                               : fmt::format("{} on {} for {}", state, node, time);
  }
  return states;
}

}  // namespace haff::campaign
