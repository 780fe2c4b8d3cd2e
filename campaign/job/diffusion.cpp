// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/job/diffusion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/observables/displacements.hpp"
#include "campaign/job/expected_rate.hpp"
#include "campaign/job/timetable.hpp"
#include "campaign/state/model.hpp"
#include "engine/initial.hpp"
#include "engine/mixture.hpp"
#include "schema/grid/observables.hpp"

namespace haff::campaign {
namespace {

// Between two looks the fastest particle is to cover this part of the box, and may cover twice as
// much.
constexpr double part_of_box = 0.125;

// Fewer collisions than this come too irregularly to be planned: the gas then collides once at a
// time.
constexpr double plannable = 30;

constexpr double most_ahead = 1e15;  // a whole number still

constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();

constexpr const char* images_key = "images";

std::string key_of(double waiting_time) {
  return fmt::format("since {}", waiting_time);
}

void append(const std::vector<engine::Vector>& vectors, std::vector<double>& values) {
  for (const engine::Vector& v : vectors) values.insert(values.end(), v.begin(), v.end());
}

std::vector<engine::Vector> vectors_at(const std::vector<double>& values, std::size_t first,
                                       std::size_t count) {
  std::vector<engine::Vector> vectors(count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < 3; ++k) vectors[i][k] = values[first + 3 * i + k];
  return vectors;
}

double fastest_of(const std::vector<engine::Vector>& velocities) {
  double fastest = 0;
  for (const engine::Vector& v : velocities)
    fastest = std::max(fastest, v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  return std::sqrt(fastest);
}

}  // namespace

Diffusion::Diffusion(const schema::Job& job)
    : job_(job), box_(engine::box_side(job.n, job.particles, job.d)), next_look_(never) {
  for (const std::string& observable : job.observables) {
    const auto tau = schema::waiting_time(observable);
    if (!tau) continue;
    auto place = std::ranges::find(waiting_, *tau, &Waiting::tau);
    if (place == waiting_.end()) {
      waiting_.push_back({.tau = *tau, .position = {}, .velocity = {}});
      place = std::prev(waiting_.end());
    }
    (observable.starts_with("msd") ? place->msd : place->vacf) = true;
  }
  std::ranges::sort(waiting_, {}, &Waiting::tau);
}

void Diffusion::begin(const engine::Simulation& gas, const engine::State& state) {
  if (waiting_.empty()) return;
  position_ = by_id(gas.positions(), gas, 0);
  velocity_ = by_id(gas.velocities(), gas, gas.exponent());
  time_ = gas.time();
  collisions_ = gas.collisions();
  rate_ = expected_rate();
  next_look_ = collisions_ + collisions_ahead(fastest_of(velocity_));

  const std::size_t particles = position_.size();
  images_.assign(particles, {});
  if (const auto found = state.memory.find(images_key); found != state.memory.end())
    images_ = vectors_at(found->second, 0, particles);
  for (Waiting& each : waiting_) {
    each.position.clear();
    const auto found = state.memory.find(key_of(each.tau));
    if (found == state.memory.end()) continue;
    const std::vector<double>& values = found->second;
    each.position = vectors_at(values, 0, particles);
    each.velocity = vectors_at(values, 3 * particles, particles);
    each.last_lag = values[6 * particles];
    each.last_msd = values[6 * particles + 1];
  }
}

void Diffusion::store(engine::State& state) const {
  if (waiting_.empty()) return;
  append(images_, state.memory[images_key]);
  for (const Waiting& each : waiting_) {
    if (each.position.empty()) continue;
    std::vector<double>& values = state.memory[key_of(each.tau)];
    values.reserve(6 * each.position.size() + 2);
    append(each.position, values);
    append(each.velocity, values);
    values.insert(values.end(), {each.last_lag, each.last_msd});
  }
}

void Diffusion::look(const engine::Simulation& gas) {
  if (waiting_.empty() || gas.collisions() == collisions_) return;
  const Vectors position = by_id(gas.positions(), gas, 0);
  const Vectors velocity = by_id(gas.velocities(), gas, gas.exponent());
  const double elapsed = gas.time() - time_;
  const double fastest = std::max(fastest_of(velocity_), fastest_of(velocity));
  // After one collision only its two partners may be elsewhere than their velocities before and
  // after say, by half of `elapsed` times the change of velocity. Half a box tells images apart.
  const double allowed = gas.collisions() == collisions_ + 1 ? 0.5 : 2 * part_of_box;
  if (!(fastest * elapsed < allowed * box_))
    throw engine::PhysicsError(
        fmt::format("msd and vacf: after {} collisions the fastest particle came {:.3g} of the box "
                    "within {} of "
                    "them, too far to follow it through the faces of the box; expected a larger N",
                    gas.collisions(), fastest * elapsed / box_, gas.collisions() - collisions_));
  for (std::size_t i = 0; i < position.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const double expected = position_[i][k] + 0.5 * elapsed * (velocity_[i][k] + velocity[i][k]);
      images_[i][k] += std::nearbyint((expected - position[i][k]) / box_);
    }
  const auto between = static_cast<double>(gas.collisions() - collisions_);
  if (between >= plannable) rate_ = between / elapsed;
  position_ = position;
  velocity_ = velocity;
  time_ = gas.time();
  collisions_ = gas.collisions();
  next_look_ = collisions_ + collisions_ahead(fastest_of(velocity));
}

std::int64_t Diffusion::collisions_ahead(double fastest) const {
  const double planned = rate_ * part_of_box * box_ / fastest;
  return planned >= plannable ? static_cast<std::int64_t>(std::min(planned, most_ahead)) : 1;
}

// The rate of a homogeneous gas, for a gas that has not been watched yet. A gas that has clustered
// collides more often, and is merely looked at more often than necessary.
double Diffusion::expected_rate() const {
  const auto mixture = mixture_of(job_);
  double energy = 0;
  for (std::size_t i = 0; i < velocity_.size(); ++i) {
    const double mass = mixture ? mixture->mass_of(static_cast<std::uint32_t>(i)) : 1;
    const engine::Vector& v = velocity_[i];
    energy += mass * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  }
  const double temperature = energy / (job_.d * static_cast<double>(job_.particles));
  return 0.5 * job_.particles * expected_collision_rate(job_, temperature);
}

std::vector<schema::Profile> Diffusion::sample(const engine::Simulation& gas, double tau) {
  if (waiting_.empty()) return {};
  look(gas);
  const Vectors here = unwrapped();
  std::vector<schema::Profile> points;
  for (Waiting& each : waiting_) {
    const double lag = tau - each.tau;
    const bool is_now = std::abs(lag) < 0.5 * job_.sample_every && is_at_interval(job_, tau);
    if (each.position.empty() && is_now) {
      each.position = here;
      each.velocity = velocity_;
      each.last_lag = each.last_msd = 0;
    }
    if (each.position.empty()) continue;
    const double x = is_now ? 0 : lag;
    const auto add = [&](const char* name, double value) {
      points.push_back({.name = name, .tau = each.tau, .x = {x}, .value = {value}});
    };
    if (each.vacf) add("vacf", analysis::velocity_autocorrelation(velocity_, each.velocity));
    if (!each.msd || is_now) continue;
    const double msd = analysis::mean_square_displacement(here, each.position);
    add("msd", msd);
    add("diffusion", (msd - each.last_msd) / (2 * job_.d * (x - each.last_lag)));
    each.last_lag = x;
    each.last_msd = msd;
  }
  return points;
}

Diffusion::Vectors Diffusion::by_id(const Vectors& values, const engine::Simulation& gas,
                                    int exponent) const {
  Vectors sorted(values.size());
  const auto ids = gas.ids();
  for (std::size_t i = 0; i < ids.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      sorted[ids[i]][k] = exponent == 0 ? values[i][k] : std::ldexp(values[i][k], -exponent);
  return sorted;
}

Diffusion::Vectors Diffusion::unwrapped() const {
  Vectors all = position_;
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) all[i][k] += box_ * images_[i][k];
  return all;
}

}  // namespace haff::campaign
