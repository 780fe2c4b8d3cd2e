#include "campaign/run/ledger.hpp"

#include <algorithm>

namespace haff::campaign {
namespace {

// Without an expectation: a million collisions a second. Only ratios count.
double weight_of(const schema::JobRow& row) {
  return row.expected_cpu_seconds.value_or(0.5e-6 * row.tau_max * row.job.particles);
}

bool is_over(schema::Status status) {
  return status != schema::Status::pending && status != schema::Status::running;
}

}  // namespace

Ledger::Ledger(const schema::Reader& store) : start_(std::chrono::steady_clock::now()) {
  refresh(store);
  weight_at_start_ = done_weight();
}

void Ledger::refresh(const schema::Reader& store) {
  for (const schema::JobRow& row : store.jobs()) {
    Entry& entry = jobs_[row.job_id];
    const double stored = std::min(1.0, row.progress.tau / row.tau_max);
    // Between two commits a running job is further than the store knows.
    const bool goes_on = row.status == schema::Status::running && entry.status == row.status;
    entry.fraction = is_over(row.status) ? 1 : goes_on ? std::max(entry.fraction, stored) : stored;
    entry.weight = weight_of(row);
    entry.status = row.status;
  }
}

void Ledger::note(const ProgressReport& report) {
  const auto entry = jobs_.find(report.job_id);
  if (entry != jobs_.end() && !is_over(entry->second.status))
    entry->second.fraction = std::min(1.0, report.tau / report.tau_max);
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
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
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
