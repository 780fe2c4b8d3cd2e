// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/job/timetable.hpp"

#include <algorithm>
#include <cmath>

#include "engine/simulation.hpp"

namespace haff::campaign {
namespace {

// k sample_every and tau_max are both rounded: what differs by less than this is the same place.
// [relative]
constexpr double rounding = 1e-12;

// Samples at other tau are sample_every away.
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
  if (!job.profiles_every) return false;
  const double k = std::round(tau / *job.profiles_every);
  return is_same(tau, k * *job.profiles_every, job.sample_every);
}

bool has_fields(const schema::Job& job, double tau) {
  return std::any_of(job.fields_at.begin(), job.fields_at.end(),
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

Timetable::Timetable(const schema::Job& job, double tau_max, double checkpoint_every)
    : sample_every_(job.sample_every),
      checkpoint_every_(checkpoint_every),
      particles_(job.particles),
      samples_(sample_count(job.sample_every, tau_max)),
      last_synchronization_(whole(
          std::floor(sample_tau(sample_every_, samples_ - 1) / engine::synchronization_period))) {}

void Timetable::skip_through(std::int64_t collisions) {
  while (next_sample_ < samples_ && sample().collisions <= collisions) ++next_sample_;
  while (next_synchronization_ <= last_synchronization_ &&
         synchronization().collisions <= collisions)
    ++next_synchronization_;
}

std::optional<Stop> Timetable::next() {
  const bool sample_left = next_sample_ < samples_;
  const bool synchronization_left = next_synchronization_ <= last_synchronization_;
  if (!sample_left && !synchronization_left) return std::nullopt;
  const bool sample_first =
      !synchronization_left || (sample_left && sample().collisions <= synchronization().collisions);
  const Stop stop = sample_first ? sample() : synchronization();
  ++(sample_first ? next_sample_ : next_synchronization_);
  return stop;
}

Stop Timetable::sample() const {
  const double tau = sample_tau(sample_every_, next_sample_);
  return {Stop::Due::sample, tau, engine::collisions_at(tau, particles_), false};
}

Stop Timetable::synchronization() const {
  const double tau = synchronization_tau(next_synchronization_);
  return {Stop::Due::synchronization, tau, engine::collisions_at(tau, particles_),
          next_synchronization_ == last_synchronization_ ||
              is_checkpoint(next_synchronization_, checkpoint_every_)};
}

}  // namespace haff::campaign
