// SPDX-License-Identifier: GPL-3.0-or-later

// A collision rule that also counts its collisions in bins (collision_counts.hpp), for the
// observable collision_statistics. It is compiled into event loops of its own, so that a gas that
// is not observed has none of its instructions.
//
//   free time     C - C_last, the collisions of the whole gas since the particle's last one:
//                 2 (C - C_last) / N on the collision clock tau. As dtau = omega dt, this is the
//                 free time over the mean free time, however the temperature changes meanwhile.
//   impact        with r and v of the pair at contact, b^2 = 1 - (r.v)^2 / (r^2 v^2)
//   normal speed  |r.v| / r, over sqrt(T/mu). T = 2E/d follows the collisions: E is the energy at
//                 the last synchronization plus the change by collisions since.
//
// The rule reads the records and changes nothing in them, so the trajectory keeps its bits. The
// counts and the last collision of every particle are in the memory of the state.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

#include "engine/collision/any_collision.hpp"
#include "engine/collision_counts.hpp"

namespace haff::engine {

template <class PairGeometry = HardSpheres>
class ObservedCollision : public AnyCollision<PairGeometry> {
  using Rule = AnyCollision<PairGeometry>;

 public:
  using Rule::Rule;

  double collide(Particle& a, Particle& b, double now, const Box& box, Clock& clock) {
    count_meeting(a, b, now, box, clock.energy);
    ++collisions_;
    count_flight(a.id);
    count_flight(b.id);
    const double before = energy_of(a) + energy_of(b);
    const double approach = Rule::collide(a, b, now, box, clock);
    gained_ += energy_of(a) + energy_of(b) - before;
    return approach;
  }

  CollisionCounts take_counts() { return std::exchange(counts_, {}); }

  void recall(const State& state) {
    Rule::recall(state);
    collisions_ = state.collisions;
    last_.assign(state.id.size(), none);
    counts_ = {};
    const auto last = state.memory.find(last_key);
    const auto counts = state.memory.find(counts_key);
    if (last == state.memory.end() || counts == state.memory.end()) return;
    if (last->second.size() != last_.size() || counts->second.size() != bins)
      throw std::invalid_argument("the state remembers collisions of other particles");
    const auto happened = static_cast<double>(state.collisions);
    const auto is_possible = [&](double number) { return number >= none && number <= happened; };
    // Each collision is in a bin of every kind, and in two of free times.
    const auto is_count = [&](double number) { return number >= 0 && number <= 2 * happened; };
    if (!std::ranges::all_of(last->second, is_possible) ||
        !std::ranges::all_of(counts->second, is_count))
      throw std::invalid_argument("the state remembers collisions that have not happened");
    last_ = last->second;
    const double* from = counts->second.data();
    for_each_bin(counts_, [&](std::int64_t& count) { count = static_cast<std::int64_t>(*from++); });
  }
  void store(State& state) const {
    Rule::store(state);
    state.memory[last_key] = last_;
    std::vector<double>& values = state.memory[counts_key];
    values.reserve(bins);
    for_each_bin(counts_,
                 [&](std::int64_t count) { values.push_back(static_cast<double>(count)); });
  }
  // Called when the clock has noted the energy anew.
  void scale(int exponent) {
    Rule::scale(exponent);
    gained_ = 0;
  }
  std::size_t memory() const { return Rule::memory() + last_.capacity() * sizeof(double); }

 private:
  static constexpr const char* counts_key = "collision_counts";
  static constexpr const char* last_key = "last_collision";
  static constexpr double none = -1;
  static constexpr std::size_t bins = CollisionCounts::bins_of_free_time + 1 +
                                      CollisionCounts::bins_of_impact +
                                      CollisionCounts::bins_of_normal_speed + 1;

  template <class Counts, class Visit>
  static void for_each_bin(Counts& counts, const Visit& visit) {
    for (auto& count : counts.free_time) visit(count);
    for (auto& count : counts.impact) visit(count);
    for (auto& count : counts.normal_speed) visit(count);
  }

  // Counts a value in bins of width 1. The last bin takes values beyond the others and NaN.
  template <class Bins>
  static void count(Bins& all, double value) {
    const auto last = static_cast<double>(all.size() - 1);
    ++all[value < last ? static_cast<std::size_t>(std::max(value, 0.0)) : all.size() - 1];
  }

  void count_meeting(const Particle& a, const Particle& b, double now, const Box& box,
                     double energy) {
    const RecordHalves of_a(a, now), of_b(b, now);
    Four r = of_b.position - of_a.position;
    to_nearest_image(r, box);
    const Four v = of_b.velocity - of_a.velocity;
    const double approach = dot(r, v);
    const double normal2 = approach * approach / dot(r, r);
    const double b2 = std::max(1 - normal2 / dot(v, v), 0.0);
    count(counts_.impact, CollisionCounts::bins_of_impact * (box.d == 2 ? std::sqrt(b2) : b2));
    const double temperature = 2 * (energy + gained_ / static_cast<double>(last_.size())) / box.d;
    const double scaled2 = ReducedMass(this->masses(), a, b).value * normal2 / temperature;
    count(counts_.normal_speed, CollisionCounts::normal_speed_resolution * std::sqrt(scaled2));
  }

  // The arithmetic is in integers: where the number of particles divides the bins evenly, each
  // flight is in exactly its bin.
  void count_flight(std::uint32_t id) {
    const std::int64_t began = static_cast<std::int64_t>(last_[id]);
    last_[id] = static_cast<double>(collisions_);
    if (began < 0) return;
    const std::int64_t bin = 2 * CollisionCounts::free_time_resolution * (collisions_ - began) /
                             static_cast<std::int64_t>(last_.size());
    ++counts_.free_time[static_cast<std::size_t>(
        std::min<std::int64_t>(bin, CollisionCounts::bins_of_free_time))];
  }

  // The energy of translation.
  double energy_of(const Particle& p) const {
    return 0.5 * this->masses().of(p) * dot(p.velocity, p.velocity);
  }

  std::int64_t collisions_ = 0;  // as the clock counts them
  double gained_ = 0;            // energy since the clock noted it, in scaled units
  std::vector<double> last_;     // by id: the number of the last collision that was observed
  CollisionCounts counts_;
};

}  // namespace haff::engine
