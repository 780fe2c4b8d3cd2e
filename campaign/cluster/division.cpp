// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/cluster/division.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "campaign/planning/run_time.hpp"

namespace haff::campaign {
namespace {

using schema::JobRow;
using schema::Kind;
using schema::Status;

// Collisions of one core in a second, for jobs without a forecast; only ratios count.
constexpr double usual_collisions_per_second = 1e6;

// A piece of work that cannot be parted: a cooling job, or an equilibration that no pending cooling
// job starts from.
struct Piece {
  const JobRow* job = nullptr;
  const JobRow* equilibration = nullptr;  // null if the job is one itself
  double cpu_seconds = 0;                 // of the job alone
  double start_cpu_seconds = 0;           // of what is left of its equilibration

  double alone() const { return cpu_seconds + start_cpu_seconds; }
};

std::vector<Piece> pieces(const std::vector<JobRow>& rows) {
  std::map<std::int64_t, const JobRow*> by_id;
  for (const JobRow& row : rows) by_id[row.job_id] = &row;

  std::vector<Piece> all;
  std::set<std::int64_t> wanted;  // equilibrations that some piece starts from
  for (const JobRow& row : rows) {
    if (row.job.kind != Kind::cooling || row.status != Status::pending) continue;
    const JobRow* start = by_id.at(row.equilibration_id.value());
    if (start->status != Status::pending && start->status != Status::done) continue;
    const double before = start->status == Status::done ? 0 : remaining_cpu_seconds(*start);
    all.push_back({&row, start, remaining_cpu_seconds(row), before});
    wanted.insert(start->job_id);
  }
  for (const JobRow& row : rows)
    if (row.job.kind == Kind::equilibration && row.status == Status::pending &&
        !wanted.contains(row.job_id))
      all.push_back({&row, nullptr, remaining_cpu_seconds(row), 0});

  // Jobs of equal cost stay in the order of the table, so that a division can be repeated.
  std::ranges::stable_sort(all, std::ranges::greater{}, &Piece::alone);
  return all;
}

class Loader {
 public:
  explicit Loader(std::size_t count) : shares_(count), starts_(count) {}

  // Gives the piece to the share whose load is then the smallest; the first of equal ones.
  void place(const Piece& piece) {
    std::size_t best = 0;
    for (std::size_t k = 1; k < shares_.size(); ++k)
      if (load_with(k, piece) < load_with(best, piece)) best = k;
    const double load = load_with(best, piece);
    Share& share = shares_[best];
    if (piece.equilibration != nullptr && starts_[best].insert(piece.equilibration->job_id).second)
      share.jobs.push_back(piece.equilibration->job_id);
    share.jobs.push_back(piece.job->job_id);
    share.cooling_jobs += piece.job->job.kind == Kind::cooling ? 1 : 0;
    share.cpu_seconds = load;
    share.longest_cpu_seconds = std::max(share.longest_cpu_seconds, piece.alone());
    note_long(piece, share.long_jobs);
  }

  std::vector<Share> take() {
    std::erase_if(shares_, [](const Share& share) { return share.jobs.empty(); });
    return std::move(shares_);
  }

 private:
  // The gain from threads depends on the box and on the number of particles in it.
  static void note_long(const Piece& piece, std::vector<LongJob>& long_jobs) {
    const schema::Job& job = piece.job->job;
    const auto same = std::ranges::find_if(long_jobs, [&](const LongJob& other) {
      return std::tie(other.job.particles, other.job.n, other.job.d) ==
             std::tie(job.particles, job.n, job.d);
    });
    if (same == long_jobs.end())
      long_jobs.push_back({job, piece.alone()});
    else
      same->cpu_seconds = std::max(same->cpu_seconds, piece.alone());
  }

  double load_with(std::size_t k, const Piece& piece) const {
    const bool has_start =
        piece.equilibration == nullptr || starts_[k].contains(piece.equilibration->job_id);
    return shares_[k].cpu_seconds + piece.cpu_seconds + (has_start ? 0 : piece.start_cpu_seconds);
  }

  std::vector<Share> shares_;
  std::vector<std::set<std::int64_t>> starts_;  // equilibrations that each share holds
};

}  // namespace

double Share::makespan(int workers) const {
  double time = cpu_seconds / workers;
  for (const LongJob& each : long_jobs)
    time = std::max(time, shortest_time(each.job, each.cpu_seconds, workers));
  return time;
}

double remaining_cpu_seconds(const JobRow& row) {
  const double collisions = row.tau_max * row.job.particles / 2;
  const double whole = row.expected_cpu_seconds.value_or(collisions / usual_collisions_per_second);
  return whole * std::clamp(1 - row.progress.tau / row.tau_max, 0.0, 1.0);
}

std::vector<Share> divide(const std::vector<JobRow>& rows, std::size_t count) {
  Loader loader(std::max<std::size_t>(count, 1));
  for (const Piece& piece : pieces(rows)) loader.place(piece);
  return loader.take();
}

}  // namespace haff::campaign
