#include "campaign/commands/status.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "campaign/accuracy/targets.hpp"
#include "campaign/base/command_text.hpp"
#include "campaign/base/duration.hpp"
#include "campaign/base/exit_code.hpp"
#include "campaign/base/job_text.hpp"
#include "campaign/base/number_text.hpp"
#include "campaign/base/output.hpp"
#include "campaign/base/printable.hpp"
#include "campaign/base/text_table.hpp"
#include "campaign/cluster/shards.hpp"
#include "campaign/results/box.hpp"
#include "campaign/results/mixed_physics.hpp"
#include "campaign/results/series.hpp"
#include "campaign/run/abandoned.hpp"

namespace haff::campaign {
namespace {

using nlohmann::ordered_json;
using schema::Kind;
using schema::Reader;
using schema::Status;

// One look at the store.
struct Picture {
  std::filesystem::path path;
  schema::Summary summary;
  std::vector<schema::JobRow> jobs;
  std::vector<schema::RunningJob> running;
  std::vector<Series> series;
  std::vector<TargetProgress> targets;
  std::optional<schema::Invariants> worst;  // of all runs; nothing before the first
  std::vector<ShardStatus> shards;
  std::vector<std::string> mixed_physics;  // a sentence for each series concerned
};

// The largest overlap, mismatch and momentum of all runs, and all counts together.
std::optional<schema::Invariants> worst_invariants(const Reader& store) {
  auto rows = store.query(
      "SELECT max(largest_overlap), sum(past_events), sum(unresolved_collisions), "
      "max(energy_mismatch), "
      "max(momentum_removed) FROM invariants");
  const auto row = rows.next().value();
  const auto* overlap = std::get_if<double>(row.data());
  if (!overlap) return std::nullopt;
  return schema::Invariants{.largest_overlap = *overlap,
                            .past_events = std::get<std::int64_t>(row[1]),
                            .unresolved_collisions = std::get<std::int64_t>(row[2]),
                            .energy_mismatch = std::get<double>(row[3]),
                            .momentum_removed = std::get<double>(row[4])};
}

Picture look(const Reader& store) {
  return {store.path(),
          store.summary(),
          store.jobs(),
          store.running(),
          series_of(store),
          progress_of(store, store.targets()),
          worst_invariants(store),
          shard_states(store),
          mixed_physics(store)};
}

double fraction_done(const schema::Summary& summary) {
  if (summary.expected_cpu_seconds <= 0) return 0;
  return summary.reached_cpu_seconds / summary.expected_cpu_seconds;
}

// What to do now, in the order in which it helps.
std::vector<std::string> next_commands(const Picture& picture) {
  const schema::Summary& summary = picture.summary;
  std::vector<std::string> commands;
  if (summary.jobs.at(Status::failed) > 0) commands.emplace_back("retry");
  const bool abandoned = std::ranges::any_of(picture.running, is_owner_dead);
  const bool nothing_runs = picture.running.empty() || abandoned;
  const bool short_of_target = std::ranges::any_of(
      picture.targets,
      [](const TargetProgress& target) { return target.verdict == Verdict::short_of; });
  if (nothing_runs &&
      (abandoned || !commands.empty() || short_of_target || summary.jobs.at(Status::pending) > 0))
    commands.emplace_back("run");
  if (summary.jobs.at(Status::done) > 0 && commands.empty() && picture.running.empty())
    commands.emplace_back("figures");
  if (picture.jobs.empty()) commands.emplace_back("plan GRID.json");
  for (std::string& command : commands) command = command_text(command, picture.path);
  return commands;
}

// The failed equilibration that keeps a job from being run.
std::optional<std::int64_t> blocked_by(const schema::JobRow& row,
                                       const std::map<std::int64_t, Status>& status_of) {
  if (row.status != Status::pending || !row.equilibration_id) return std::nullopt;
  const auto found = status_of.find(*row.equilibration_id);
  const bool blocked = found != status_of.end() && found->second == Status::failed;
  return blocked ? row.equilibration_id : std::nullopt;
}

std::map<std::int64_t, Status> status_of_each(const std::vector<schema::JobRow>& jobs) {
  std::map<std::int64_t, Status> status;
  for (const schema::JobRow& row : jobs) status[row.job_id] = row.status;
  return status;
}

// ---- for people -------------------------------------------------------------------------------

std::string jobs_table(const std::vector<schema::JobRow>& jobs) {
  std::map<std::pair<Status, Kind>, int> counts;
  for (const schema::JobRow& row : jobs) ++counts[{row.status, row.job.kind}];
  TextTable table({{"status", Align::left}, {"equilibrations"}, {"cooling"}, {"", Align::left}});
  for (const schema::StatusEntry& entry : schema::statuses)
    table.add({std::string(entry.name), count_text(counts[{entry.status, Kind::equilibration}]),
               count_text(counts[{entry.status, Kind::cooling}]), std::string(entry.meaning)});
  return table.text();
}

std::string running_table(const std::vector<schema::RunningJob>& running) {
  TextTable table({{"job"},
                   {"running", Align::left},
                   {"tau"},
                   {"tau_max"},
                   {"process"},
                   {"host", Align::left},
                   {"", Align::left}});
  for (const schema::RunningJob& job : running)
    table.add({std::to_string(job.lease.job_id), describe(job.job),
               fmt::format("{:.1f}", job.progress.tau), number_text(job.tau_max),
               std::to_string(job.owner.pid), job.owner.host,
               is_owner_dead(job) ? "is gone; the next run takes the job back" : ""});
  return table.text();
}

std::string shards_table(const std::vector<ShardStatus>& shards) {
  TextTable table({{"shard", Align::left},
                   {"jobs"},
                   {"still lent"},
                   {"done"},
                   {"CPU time"},
                   {"merged", Align::left},
                   {"Slurm", Align::left},
                   {"where", Align::left}});
  for (const ShardStatus& each : shards)
    table.add({each.shard.name, count_text(each.shard.jobs), count_text(each.shard.unfinished),
               each.fraction ? fmt::format("{:.1f} %", 100 * *each.fraction) : no_value,
               duration_text(each.shard.cpu_seconds), each.shard.merged.value_or(no_value),
               each.slurm.empty() ? no_value : each.slurm, each.where});
  return table.text();
}

std::string failures_text(const Picture& picture) {
  const auto status = status_of_each(picture.jobs);
  std::string text;
  std::map<std::int64_t, int> blocked;
  for (const schema::JobRow& row : picture.jobs) {
    if (row.status == Status::failed || row.status == Status::collapsed)
      text += fmt::format("job {} ({}) {}: {}\n", row.job_id, describe(row.job), name(row.status),
                          printable(row.error.value_or("for no reason known")));
    if (const auto id = blocked_by(row, status)) ++blocked[*id];
  }
  for (const auto& [id, count] : blocked)
    text += fmt::format("{} cooling job{} blocked: the equilibration, job {}, failed\n", count,
                        count == 1 ? " is" : "s are", id);
  return text;
}

std::string invariants_text(const schema::Invariants& worst) {
  return fmt::format(
      "Physics: overlap at most {:.1e} sigma, {} events in the past, {} watchdog trips, energy "
      "balanced to {:.1e}, momentum to {:.1e}\n",
      worst.largest_overlap, worst.past_events, worst.unresolved_collisions, worst.energy_mismatch,
      worst.momentum_removed);
}

std::string next_text(const Picture& picture) {
  std::string text;
  for (const std::string& command : next_commands(picture))
    text += fmt::format("{}{}\n", text.empty() ? "Next: " : "      ", command);
  return text;
}

// What jobs that are done took, beside what was expected for them.
std::string cpu_time_text(const Picture& picture) {
  const schema::Summary& summary = picture.summary;
  std::string text =
      fmt::format("CPU time: {} spent, {} expected in all, {} of it to come\n",
                  duration_text(summary.cpu_seconds), duration_text(summary.expected_cpu_seconds),
                  duration_text(summary.remaining_cpu_seconds));
  double expected = 0, spent = 0;
  for (const schema::JobRow& row : picture.jobs)
    if (row.status == Status::done && row.expected_cpu_seconds) {
      expected += *row.expected_cpu_seconds;
      spent += row.progress.cpu_seconds;
    }
  if (expected > 0)
    text += fmt::format("          jobs that are done took {}, {} was expected for them\n",
                        duration_text(spent), duration_text(expected));
  if (const double more = cpu_seconds_unplanned(picture.targets); more > 0)
    text += fmt::format("          and some {} for the targets, beyond what is planned\n",
                        duration_text(more));
  return text;
}

// What a target was expected to take when its pilot runs were done, beside what it has taken.
std::string predictions_text(const std::vector<TargetProgress>& targets) {
  std::string text;
  for (const TargetProgress& each : targets)
    if (const auto& predicted = each.target.prediction)
      text += fmt::format(
          "{} (e {}, n {}, N {}): {} realizations and {} were expected after the pilot runs; "
          "{} are done and took {}\n",
          describe(each.target), e_text(each.job), number_text(each.job.n),
          count_text(each.job.particles),
          count_text(static_cast<long long>(predicted->realizations)),
          duration_text(predicted->cpu_seconds),
          count_text(static_cast<long long>(each.estimate.count)),
          duration_text(each.spent_cpu_seconds));
  return text;
}

// Series, targets, failures, and what to do.
void print_findings(const Picture& picture) {
  if (!picture.series.empty()) say("{}\n", series_table(picture.series));
  if (!picture.targets.empty()) say("{}\n", targets_table(picture.targets));
  if (const std::string text = predictions_text(picture.targets); !text.empty()) say("{}\n", text);
  const std::string failures = failures_text(picture);
  if (!failures.empty()) say("{}\n", failures);
  for (const std::string& sentence : picture.mixed_physics) say("Note: {}\n", sentence);
  say("{}", next_text(picture));
}

void print_picture(const Picture& picture) {
  const schema::Summary& summary = picture.summary;
  say("{}: {} jobs, {:.1f} % of the work done\n\n", picture.path.string(), picture.jobs.size(),
      100 * fraction_done(summary));
  say("{}\n", jobs_table(picture.jobs));
  say("{}\n", cpu_time_text(picture));
  if (picture.worst) say("{}\n", invariants_text(*picture.worst));
  if (!picture.running.empty()) say("{}\n", running_table(picture.running));
  if (!picture.shards.empty()) say("{}\n", shards_table(picture.shards));
  print_findings(picture);
}

// ---- for programs -----------------------------------------------------------------------------

template <class T>
ordered_json or_null(const std::optional<T>& value) {
  return value ? ordered_json(*value) : ordered_json(nullptr);
}

ordered_json physics_json(const schema::Job& job) {
  return {{"kind", name(job.kind)},
          {"d", job.d},
          {"e", or_null(job.e)},
          {"n", job.n},
          {"particles", job.particles},
          {"equilibrate", job.equilibrate},
          {"sample_every", job.sample_every},
          {"effects", ordered_json::parse(job.effects)}};
}

ordered_json running_json(const schema::RunningJob& job) {
  ordered_json object = physics_json(job.job);
  object.update({{"job_id", job.lease.job_id},
                 {"seed", job.job.seed},
                 {"tau", job.progress.tau},
                 {"tau_max", job.tau_max},
                 {"host", job.owner.host},
                 {"pid", job.owner.pid},
                 {"abandoned", is_owner_dead(job)}});
  return object;
}

// What the box can hold by linear theory; null for gases that it does not treat.
ordered_json box_json(const schema::Job& job) {
  const auto box = box_report(job);
  if (!box) return nullptr;
  return {{"side", box->side},
          {"vortex_length", box->vortex_length},
          {"cluster_length", box->cluster_length},
          {"vortices_across", box->vortices_across},
          {"clusters_across", box->clusters_across},
          {"fastest_wave", or_null(box->fastest_wave)},
          {"fastest_rate", or_null(box->fastest_rate)},
          {"waves_across", or_null(box->waves_across)},
          {"grown_tau", or_null(box->grown_tau)},
          {"haff_particles", box->haff_particles},
          {"keeps_haff", box->keeps_haff}};
}

ordered_json series_json(const Series& series) {
  ordered_json object = physics_json(series.job);
  object.update({{"realizations_planned", series.planned},
                 {"realizations", series.done},
                 {"tau", series.tau},
                 {"tau_max", series.tau_max},
                 {"reached", series.reached},
                 {"tau_c", or_null(series.tau_c)},
                 {"tau_c_se", or_null(series.tau_c_se)},
                 {"published_tau_c", or_null(series.published_tau_c)},
                 {"box", box_json(series.job)}});
  return object;
}

ordered_json shard_json(const ShardStatus& each) {
  return {{"shard", each.shard.name},
          {"path", each.shard.path.string()},
          {"jobs", each.shard.jobs},
          {"still_lent", each.shard.unfinished},
          {"fraction_done", or_null(each.fraction)},
          {"cpu_seconds", each.shard.cpu_seconds},
          {"lent", each.shard.lent},
          {"merged", or_null(each.shard.merged)},
          {"returned", or_null(each.shard.returned)},
          {"slurm", each.slurm.empty() ? ordered_json(nullptr) : ordered_json(each.slurm)}};
}

ordered_json prediction_json(const std::optional<schema::Prediction>& prediction) {
  if (!prediction) return nullptr;
  return {{"realizations", prediction->realizations}, {"cpu_seconds", prediction->cpu_seconds}};
}

ordered_json target_json(const TargetProgress& progress) {
  ordered_json object = physics_json(progress.job);
  const bool has_mean = progress.estimate.count > 0, has_error = progress.estimate.count > 1;
  object.update(
      {{"quantity", progress.target.quantity},
       {"tau", {progress.target.tau_from, progress.target.tau_to}},
       {"se_wanted", progress.target.se},
       {"realizations", progress.estimate.count},
       {"realizations_expected",
        progress.expected > 0 ? ordered_json(progress.expected) : ordered_json(nullptr)},
       {"mean", has_mean ? ordered_json(progress.estimate.mean) : ordered_json(nullptr)},
       {"se", has_error ? ordered_json(progress.estimate.standard_error) : ordered_json(nullptr)},
       {"half_interval", or_null(progress.half_interval)},
       {"cpu_seconds", progress.spent_cpu_seconds},
       {"cpu_seconds_unplanned", progress.cpu_seconds},
       {"cpu_seconds_to_come", progress.cpu_seconds_to_come()},
       {"predicted", prediction_json(progress.target.prediction)},
       {"verdict", name(progress.verdict)}});
  return object;
}

ordered_json failure_json(const schema::JobRow& row) {
  ordered_json object = physics_json(row.job);
  object.update({{"job_id", row.job_id},
                 {"seed", row.job.seed},
                 {"status", name(row.status)},
                 {"error", or_null(row.error)}});
  return object;
}

ordered_json invariants_json(const schema::Invariants& worst) {
  return {{"largest_overlap", worst.largest_overlap},
          {"past_events", worst.past_events},
          {"unresolved_collisions", worst.unresolved_collisions},
          {"energy_mismatch", worst.energy_mismatch},
          {"momentum_removed", worst.momentum_removed}};
}

ordered_json picture_json(const Picture& picture) {
  const schema::Summary& summary = picture.summary;
  ordered_json counts = ordered_json::object();
  for (const schema::StatusEntry& entry : schema::statuses)
    counts[std::string(entry.name)] = summary.jobs.at(entry.status);
  ordered_json object{
      {"store", picture.path.string()},
      {"jobs", counts},
      {"fraction_done", fraction_done(summary)},
      {"cpu_seconds", summary.cpu_seconds},
      {"expected_cpu_seconds", summary.expected_cpu_seconds},
      {"remaining_cpu_seconds",
       summary.remaining_cpu_seconds + cpu_seconds_unplanned(picture.targets)},
      {"invariants", picture.worst ? invariants_json(*picture.worst) : ordered_json(nullptr)},
      {"running", ordered_json::array()},
      {"shards", ordered_json::array()},
      {"series", ordered_json::array()},
      {"targets", ordered_json::array()},
      {"failures", ordered_json::array()},
      {"blocked", ordered_json::array()},
      {"next", next_commands(picture)},
  };
  for (const auto& job : picture.running) object["running"].push_back(running_json(job));
  for (const ShardStatus& each : picture.shards) object["shards"].push_back(shard_json(each));
  for (const Series& series : picture.series) object["series"].push_back(series_json(series));
  for (const TargetProgress& target : picture.targets)
    object["targets"].push_back(target_json(target));
  const auto status = status_of_each(picture.jobs);
  for (const schema::JobRow& row : picture.jobs) {
    if (row.status == Status::failed || row.status == Status::collapsed)
      object["failures"].push_back(failure_json(row));
    if (const auto id = blocked_by(row, status))
      object["blocked"].push_back({{"job_id", row.job_id}, {"equilibration_id", *id}});
  }
  return object;
}

}  // namespace

int status(const std::filesystem::path& path, bool json) {
  const Picture picture = look(Reader(path));
  if (json)
    print_data(picture_json(picture).dump(2, ' ', false, ordered_json::error_handler_t::replace) +
               '\n');
  else
    print_picture(picture);
  return exit_complete;
}

void print_outcome(const Reader& store) {
  print_findings(look(store));
}

}  // namespace haff::campaign
