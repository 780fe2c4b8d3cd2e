// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/report/overview_json.hpp"

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "campaign/results/box.hpp"
#include "campaign/run/abandoned.hpp"

namespace haff::campaign {
namespace {

using nlohmann::ordered_json;
using schema::Status;

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
          {"start", ordered_json::parse(schema::start_text(job.start))},
          {"equilibrate", job.equilibrate},
          {"sample_every", job.sample_every},
          {"sample_at", job.sample_at.empty()
                            ? ordered_json(nullptr)
                            : ordered_json::parse(schema::schedule_text(job.sample_at))},
          {"effects", ordered_json::parse(job.effects.text())}};
}

ordered_json running_json(const schema::RunningJob& job) {
  ordered_json object = physics_json(job.job);
  object.update({{"job_id", job.lease.job_id},
                 {"seed", job.job.seed},
                 {"tau_reached", job.progress.tau},
                 {"tau_max", job.tau_max},
                 {"host", job.owner.host},
                 {"pid", job.owner.pid},
                 {"abandoned", is_owner_dead(job)}});
  return object;
}

ordered_json series_json(const Series& series) {
  ordered_json object = physics_json(series.job);
  object.update({{"realizations_planned", series.planned},
                 {"realizations", series.done},
                 {"tau_reached", series.tau},
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

ordered_json prediction_json(const std::optional<schema::CostPrediction>& prediction) {
  if (!prediction) return nullptr;
  return {{"realizations", prediction->realizations}, {"cpu_seconds", prediction->cpu_seconds}};
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

}  // namespace

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

ordered_json overview_json(const Overview& overview) {
  const schema::Summary& summary = overview.summary;
  ordered_json counts = ordered_json::object();
  for (const schema::StatusEntry& entry : schema::statuses)
    counts[std::string(entry.name)] = summary.jobs.at(entry.status);
  ordered_json object{
      {"store", overview.path.string()},
      {"jobs", counts},
      {"fraction_done", fraction_done(summary)},
      {"cpu_seconds", summary.cpu_seconds},
      {"expected_cpu_seconds", summary.expected_cpu_seconds},
      {"remaining_cpu_seconds",
       summary.remaining_cpu_seconds + cpu_seconds_unplanned(overview.targets)},
      {"seconds_left", or_null(seconds_left(overview))},
      {"invariants", overview.worst ? invariants_json(*overview.worst) : ordered_json(nullptr)},
      {"running", ordered_json::array()},
      {"shards", ordered_json::array()},
      {"series", ordered_json::array()},
      {"targets", ordered_json::array()},
      {"failures", ordered_json::array()},
      {"blocked", ordered_json::array()},
      {"notes", overview.mixed_physics},
      {"next", next_commands(overview)},
  };
  for (const auto& job : overview.running) object["running"].push_back(running_json(job));
  for (const ShardStatus& each : overview.shards) object["shards"].push_back(shard_json(each));
  for (const Series& series : overview.series) object["series"].push_back(series_json(series));
  for (const TargetProgress& target : overview.targets)
    object["targets"].push_back(target_json(target));
  const auto status = status_of_each(overview.jobs);
  for (const schema::JobRow& row : overview.jobs) {
    if (row.status == Status::failed || row.status == Status::collapsed)
      object["failures"].push_back(failure_json(row));
    if (const auto id = blocked_by(row, status))
      object["blocked"].push_back({{"job_id", row.job_id}, {"equilibration_id", *id}});
  }
  return object;
}

}  // namespace haff::campaign
