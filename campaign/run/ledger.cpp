// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/run/ledger.hpp"

#include <algorithm>
#include <utility>

namespace haff::campaign {
namespace {

// Reading all jobs may take at most this part of the time.
constexpr double share_of_reading = 0.02;

// Where no cost is expected, a million collisions a second; only ratios count.
double weight_of(const schema::JobRow& row) {
  return row.expected_cpu_seconds.value_or(0.5e-6 * row.tau_max * row.job.particles);
}

// The counts come from an index, unless only some jobs count.
std::map<schema::Status, std::int64_t> counts_of(const schema::Selection& store) {
  return store.choice().is_everything() ? store.job_counts() : store.summary().jobs;
}

// Nothing is left to do. What a failed job had stored counts as done.
bool is_complete(schema::Status status) {
  return status == schema::Status::done || status == schema::Status::collapsed;
}

}  // namespace

Ledger::Ledger(const schema::Selection& store) : start_(Clock::now()) {
  read_all(store);
  weight_at_start_ = done_weight();
}

void Ledger::refresh(const schema::Selection& store) {
  std::set<std::int64_t> running;
  for (const schema::RunningJob& job : store.running()) running.insert(job.lease.job_id);
  restless_.insert(running.begin(), running.end());
  bool some_are_gone = false;
  for (const std::int64_t id : restless_) try {
      if (jobs_.contains(id)) update(store.job(id));
    } catch (const schema::NameError&) {  // it was cancelled meanwhile
      some_are_gone = true;
    }
  restless_ = std::move(running);
  if (some_are_gone || (Clock::now() >= next_read_of_all_ && !agrees_with(counts_of(store))))
    read_all(store);
}

void Ledger::read_all(const schema::Selection& store) {
  const auto before = Clock::now();
  const bool takes_all = store.choice().is_everything();
  const auto chosen = takes_all ? std::set<std::int64_t>() : store.job_ids();
  std::map<std::int64_t, Entry> earlier;
  std::swap(jobs_, earlier);
  counts_.clear();
  for (const schema::JobRow& row : store.jobs()) {
    if (!takes_all && !chosen.contains(row.job_id)) continue;
    if (const auto known = earlier.find(row.job_id); known != earlier.end()) {
      jobs_.insert(*known);
      ++counts_[known->second.status];
    }
    update(row);
  }
  const auto now = Clock::now();
  next_read_of_all_ =
      now + std::chrono::duration_cast<Clock::duration>((now - before) / share_of_reading);
}

void Ledger::update(const schema::JobRow& row) {
  const auto [place, is_new] = jobs_.try_emplace(row.job_id);
  Entry& entry = place->second;
  if (!is_new) --counts_[entry.status];
  ++counts_[row.status];
  const double stored = std::min(1.0, row.progress.tau / row.tau_max);
  // Between two commits a running job has come further than is stored.
  const bool goes_on = row.status == schema::Status::running && entry.status == row.status;
  entry.fraction = is_complete(row.status) ? 1
                   : goes_on               ? std::max(entry.fraction, stored)
                                           : stored;
  entry.weight = weight_of(row);
  entry.status = row.status;
}

void Ledger::note(const ProgressReport& report) {
  restless_.insert(report.job_id);
  const auto entry = jobs_.find(report.job_id);
  if (entry != jobs_.end() && !is_complete(entry->second.status))
    entry->second.fraction = std::min(1.0, report.tau / report.tau_max);
}

bool Ledger::agrees_with(const std::map<schema::Status, std::int64_t>& counts) const {
  const auto number = [](const auto& of, schema::Status status) {
    const auto found = of.find(status);
    return found == of.end() ? 0 : found->second;
  };
  return std::ranges::all_of(schema::statuses, [&](const schema::StatusEntry& entry) {
    return number(counts_, entry.status) == number(counts, entry.status);
  });
}

Totals Ledger::totals() const {
  Totals totals;
  totals.jobs = jobs_.size();
  double weight = 0;
  for (const auto& [id, entry] : jobs_) {
    totals.done += entry.status == schema::Status::done;
    totals.failed += entry.status == schema::Status::failed;
    weight += entry.weight;
  }
  const double done = done_weight();
  if (weight > 0) totals.fraction = done / weight;
  const std::chrono::duration<double> elapsed = Clock::now() - start_;
  if (done > weight_at_start_)
    totals.seconds_left = elapsed.count() * (weight - done) / (done - weight_at_start_);
  return totals;
}

double Ledger::done_weight() const {
  double sum = 0;
  for (const auto& [id, entry] : jobs_) sum += entry.weight * entry.fraction;
  return sum;
}

}  // namespace haff::campaign
