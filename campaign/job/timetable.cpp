// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/job/timetable.hpp"

#include <algorithm>
#include <cmath>

#include "engine/simulation.hpp"

namespace haff::campaign {
namespace {

// k sample_every and tau_max are both rounded: values that differ by less than this are equal.
// [relative]
constexpr double rounding = 1e-12;

// Samples at different tau are sample_every apart.
bool is_same(double tau, double other, double sample_every) {
  return std::abs(tau - other) < 0.5 * sample_every;
}

std::int64_t whole(double x) {
  return static_cast<std::int64_t>(x);
}

}  // namespace

std::int64_t sample_count(double sample_every, double tau_max) {
  return 1 + whole(std::floor(tau_max / sample_every * (1 + rounding)));
}

double sample_tau(double sample_every, std::int64_t k) {
  return static_cast<double>(k) * sample_every;
}

bool has_profiles(const schema::Job& job, double tau) {
  if (!job.profiles_every || !is_at_interval(job, tau)) return false;
  const double k = std::round(tau / *job.profiles_every);
  return is_same(tau, k * *job.profiles_every, job.sample_every);
}

bool has_fields(const schema::Job& job, double tau) {
  return is_at_interval(job, tau) &&
         std::any_of(job.fields_at.begin(), job.fields_at.end(),
                     [&](double at) { return is_same(tau, at, job.sample_every); });
}

double synchronization_tau(std::int64_t k) {
  return static_cast<double>(k) * engine::synchronization_period;
}

std::int64_t synchronization_at_or_after(double tau) {
  return whole(std::ceil(tau / engine::synchronization_period));
}

bool is_checkpoint(std::int64_t k, double checkpoint_every) {
  const auto multiples_through = [&](std::int64_t synchronization) {
    return std::floor(synchronization_tau(synchronization) / checkpoint_every * (1 + rounding));
  };
  return multiples_through(k) > multiples_through(k - 1);
}

SampleTaus::SampleTaus(const schema::Job& job)
    : moments_(job.sample_at.tau), sample_every_(job.sample_every), particles_(job.particles) {
  find_listed(-1);
}

void SampleTaus::advance() {
  if (is_listed())
    find_listed(listed_);
  else
    ++next_;
}

// The next moment that is a collision of its own.
void SampleTaus::find_listed(double after) {
  const auto collisions = [&](double tau) { return engine::collisions_at(tau, particles_); };
  const auto is_one = [&](double tau, double other) {
    return collisions(tau) == collisions(other) || std::abs(tau - other) <= rounding * tau;
  };
  for (listed_ = moments_.next(after); std::isfinite(listed_); listed_ = moments_.next(listed_)) {
    const std::int64_t k = whole(std::floor(listed_ / sample_every_));
    const bool is_new = !is_one(listed_, sample_tau(sample_every_, k)) &&
                        !is_one(listed_, sample_tau(sample_every_, k + 1)) &&
                        (after < 0 || !is_one(listed_, after));
    if (is_new) return;
  }
}

std::int64_t sample_count(const schema::Job& job, double tau_max) {
  std::int64_t count = sample_count(job.sample_every, tau_max);
  if (job.sample_at.tau.empty()) return count;
  const double end = tau_max * (1 + rounding);
  for (SampleTaus taus(job); taus.tau() <= end; taus.advance()) count += taus.is_listed() ? 1 : 0;
  return count;
}

namespace {

// The time that a gas is expected to take grows exponentially with tau, and may be infinite: no run
// gets there, and a logarithmic list would leave the range of doubles.
constexpr double latest_moment = 1e300;

}  // namespace

std::int64_t count_through(const schema::Moments& moments, double tau_max) {
  const double end = std::min(tau_max * (1 + rounding), latest_moment);
  std::int64_t count = 0;
  for (double tau = moments.next(-1); tau <= end; tau = moments.next(tau)) ++count;
  return count;
}

namespace {

// The last of these moments by `end`; 0 if there is none.
double last_by(const schema::Moments& moments, double end) {
  double last = 0;
  for (double tau = moments.next(-1); tau <= std::min(end, latest_moment); tau = moments.next(tau))
    last = tau;
  return last;
}

}  // namespace

Timetable::Timetable(const schema::Job& job, double tau_max, double checkpoint_every)
    : taus_(job),
      snapshots_at_(job.snapshots_at.tau),
      end_(tau_max * (1 + rounding)),
      checkpoint_every_(checkpoint_every),
      particles_(job.particles),
      samples_at_intervals_(sample_count(job.sample_every, tau_max)),
      snapshot_(snapshots_at_.next(-1)) {
  const double last = std::max({sample_tau(job.sample_every, samples_at_intervals_ - 1),
                                last_by(job.sample_at.tau, end_), last_by(snapshots_at_, end_)});
  last_synchronization_ = whole(std::floor(last / engine::synchronization_period));
}

void Timetable::skip_through(std::int64_t collisions) {
  while (const auto stop = sample()) {
    if (stop->collisions > collisions) break;
    pass(*stop);
  }
  while (const auto stop = snapshot()) {
    if (stop->collisions > collisions) break;
    pass(*stop);
  }
  while (const auto stop = synchronization()) {
    if (stop->collisions > collisions) break;
    pass(*stop);
  }
}

std::optional<Stop> Timetable::next() {
  const auto stop = first();
  if (stop) pass(*stop);
  return stop;
}

// At the same collision a sample comes before a snapshot, and a snapshot before a synchronization.
std::optional<Stop> Timetable::first() const {
  std::optional<Stop> first;
  for (const auto& stop : {sample(), snapshot(), synchronization()})
    if (stop && (!first || stop->collisions < first->collisions)) first = stop;
  return first;
}

void Timetable::pass(const Stop& stop) {
  switch (stop.due) {
    case Stop::Due::sample:
      return taus_.advance();
    case Stop::Due::snapshot:
      snapshot_ = snapshots_at_.next(snapshot_);
      return;
    case Stop::Due::synchronization:
      ++next_synchronization_;
      return;
  }
}

std::optional<Stop> Timetable::sample() const {
  const double tau = taus_.tau();
  const bool is_left =
      taus_.is_listed() ? tau <= end_ : taus_.at_intervals_before() < samples_at_intervals_;
  if (!is_left) return std::nullopt;
  return Stop{Stop::Due::sample, tau, engine::collisions_at(tau, particles_), false};
}

std::optional<Stop> Timetable::snapshot() const {
  if (!(snapshot_ <= end_)) return std::nullopt;
  return Stop{Stop::Due::snapshot, snapshot_, engine::collisions_at(snapshot_, particles_), false};
}

std::optional<Stop> Timetable::synchronization() const {
  if (next_synchronization_ > last_synchronization_) return std::nullopt;
  const double tau = synchronization_tau(next_synchronization_);
  return Stop{Stop::Due::synchronization, tau, engine::collisions_at(tau, particles_),
              next_synchronization_ == last_synchronization_ ||
                  is_checkpoint(next_synchronization_, checkpoint_every_)};
}

}  // namespace haff::campaign
