#include "campaign/commands/submit.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <stdexcept>

#include "campaign/accuracy/targets.hpp"
#include "campaign/base/command_text.hpp"
#include "campaign/base/duration.hpp"
#include "campaign/base/exit_code.hpp"
#include "campaign/base/number_text.hpp"
#include "campaign/base/output.hpp"
#include "campaign/cluster/merge.hpp"
#include "campaign/cluster/split.hpp"
#include "campaign/cluster/subprocess.hpp"
#include "campaign/commands/status.hpp"
#include "campaign/run/abandoned.hpp"

namespace haff::campaign {
namespace {

namespace fs = std::filesystem;

// ---- what came home ---------------------------------------------------------------------------

// The shards of earlier rounds that are still out.
std::vector<schema::Shard> shards_out(const schema::Store& store, const fs::path& folder) {
  std::set<fs::path> submitted;
  for (const Round& round : read_records(folder))
    submitted.insert(round.shards.begin(), round.shards.end());
  auto shards = store.shards();
  std::erase_if(shards, [&](const schema::Shard& shard) {
    return shard.returned || !submitted.contains(shard.path);
  });
  return shards;
}

// Merges one shard and removes its file, which then holds nothing that the store does not. Whether
// it brought anything.
bool bring_home(schema::Store& store, const schema::Shard& shard) try {
  const MergeOutcome outcome = merge(store, shard.path);
  store.recall(shard.name);
  std::error_code ignored;
  fs::remove(shard.path, ignored);
  say("{}: {} of {} jobs went on, {} new rows\n", shard.name, count_text(outcome.advanced),
      count_text(outcome.jobs), count_text(outcome.rows));
  return outcome.rows > 0 || outcome.advanced > 0;
} catch (const schema::StoreError& error) {
  complain("campaign: {}; its jobs are computed again\n", error.what());
  store.recall(shard.name);
  return false;
}

// ---- what is submitted ------------------------------------------------------------------------

void write_file(const fs::path& path, const std::string& text) {
  std::ofstream file(path);
  file << text;
  file.flush();
  if (!file) throw std::runtime_error(path.string() + ": cannot be written; is the disk full?");
}

std::string shell_line(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + quoted_word(word);
  return line;
}

// The number that sbatch gives a job: "123", or "123;cluster".
std::string submitted(const std::vector<std::string>& words) {
  const auto answer = ask(words);
  if (!answer || answer->exit_code != 0)
    throw std::runtime_error("sbatch refused this: " + shell_line(words));
  return answer->out.substr(0, answer->out.find_first_of(";\n"));
}

void print_dry_run(const ClusterOptions& options, const Round& round) {
  say("# {}\n{}\n# {}\n{}\n{}\n{}\n",
      round_file(options.folder, round.number, ".tasks.sh").string(), tasks_script(options, round),
      round_file(options.folder, round.number, ".merge.sh").string(), merge_script(options, round),
      shell_line(tasks_command(options, round)), shell_line(merge_command(options, round)));
  say("Nothing was written or submitted.\n");
}

// Submits the tasks and the job after them. If either is refused, nothing stays in the queue.
void enqueue(const ClusterOptions& options, Round& round) {
  std::string list;
  for (const fs::path& shard : round.shards) list += shard.string() + '\n';
  write_file(round_file(options.folder, round.number, ".shards"), list);
  write_file(round_file(options.folder, round.number, ".tasks.sh"), tasks_script(options, round));
  write_file(round_file(options.folder, round.number, ".merge.sh"), merge_script(options, round));
  write_record(options.folder, round);
  round.tasks_job = submitted(tasks_command(options, round));
  try {
    write_record(options.folder, round);
    round.merge_job = submitted(merge_command(options, round));
  } catch (...) {
    ask({"scancel", round.tasks_job});
    throw;
  }
  write_record(options.folder, round);
}

int submit_round(schema::Store& store, const ClusterOptions& options, int number) {
  const auto shards = split(store, options.tasks, options.folder);
  Round round{.number = number, .shards = {}, .tasks_job = {}, .merge_job = {}};
  double makespan = 0;
  for (const WrittenShard& shard : shards) {
    round.shards.push_back(shard.path);
    makespan = std::max(makespan, shard.share.makespan(options.cpus));
  }
  try {
    enqueue(options, round);
  } catch (...) {
    for (const WrittenShard& shard : shards) {
      store.recall(shard.name);
      std::error_code ignored;
      fs::remove(shard.path, ignored);
    }
    throw;
  }
  say("Round {}: {} task{} as Slurm job {}, merged by job {}. Expected: {} of computing for the "
      "longest task.\nTo stop: scancel {} {}; what was computed comes home with: {}\n",
      number, round.shards.size(), round.shards.size() == 1 ? "" : "s", round.tasks_job,
      round.merge_job, duration_text(makespan), round.merge_job, round.tasks_job,
      command_text("merge " + shell_word((options.folder / "").string()) + "shard-*.db",
                   options.store));
  return exit_complete;
}

// With the names as the user gave them.
int explain_other_schedulers(const ClusterOptions& options) {
  const std::string folder = shell_word(options.folder.string());
  complain(
      "campaign: there is no sbatch here, so nothing was submitted. Under another scheduler:\n"
      "  {}\n"
      "then give each shard to a task, by one of\n"
      "  GNU parallel  parallel -j {} campaign task --workers {} {{}} ::: {}/shard-*.db\n"
      "  PBS           qsub -J 1-{} -l ncpus={} -- /bin/sh -c 'campaign task --workers {} "
      "{}/shard-$(printf %03d $PBS_ARRAY_INDEX).db'\n"
      "  HTCondor      executable = campaign; arguments = task --workers {} $(shard); "
      "request_cpus = {}; queue shard matching files {}/shard-*.db\n"
      "and bring home what they computed, as often as you like:\n"
      "  {}\n",
      command_text(fmt::format("split --into {} --out {}", options.tasks, folder), options.store),
      options.tasks, options.cpus, folder, options.tasks, options.cpus, options.cpus, folder,
      options.cpus, options.cpus, folder,
      command_text("merge " + folder + "/shard-*.db", options.store));
  return exit_failed;
}

}  // namespace

int submit(const SubmitOptions& options) {
  if (!options.dry_run && !find_program("sbatch")) return explain_other_schedulers(options.cluster);
  ClusterOptions cluster = options.cluster;
  cluster.store = fs::absolute(cluster.store);
  cluster.folder = fs::absolute(cluster.folder);
  schema::Store store = schema::Store::open(cluster.store);
  take_back_from_the_dead(store);
  const auto out = shards_out(store, cluster.folder);
  if (options.round == 0 && !out.empty() && !options.dry_run)
    throw std::runtime_error(fmt::format(
        "{} is out with {} job{}, submitted before; wait for its task ({}), or take its jobs back: "
        "{}",
        out.front().name, out.front().unfinished, out.front().unfinished == 1 ? "" : "s",
        command_text("status", cluster.store),
        command_text("recall " + out.front().name, cluster.store)));
  bool has_brought = false;
  if (options.round > 0)
    for (const schema::Shard& shard : out) has_brought |= bring_home(store, shard);
  if (options.round > 0 || !options.dry_run) {
    keep_predictions(store);
    add_realizations(store, std::nullopt);
  }

  const schema::Summary summary = store.summary();
  const bool is_complete = summary.claimable + summary.waiting == 0;
  const bool has_failed = summary.jobs.at(schema::Status::failed) > 0;
  if (is_complete) {
    print_outcome(store);
    return has_failed ? exit_failed : exit_complete;
  }
  if (options.round > 0 && !has_brought)
    throw std::runtime_error(
        "no task has brought anything home, so none is submitted again; see the logs in " +
        cluster.folder.string());
  if (cluster.rounds == 0) {
    say("Work is left after the last round that --rounds allows.\nNext: {}\n",
        command_text("submit", cluster.store));
    return exit_out_of_time;
  }
  const auto records = read_records(cluster.folder);
  const int last = records.empty() ? 0 : records.back().number;
  const int number = std::max(options.round, last + 1);
  if (!options.dry_run) return submit_round(store, cluster, number);

  Round round{.number = number, .shards = {}, .tasks_job = {}, .merge_job = {}};
  round.shards.resize(divide(store.jobs(), cluster.tasks).size());
  print_dry_run(cluster, round);
  return exit_complete;
}

int task(const TaskOptions& options) {
  return work_on_shard(options);
}

}  // namespace haff::campaign
