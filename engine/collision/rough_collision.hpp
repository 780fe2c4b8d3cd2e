// SPDX-License-Identifier: GPL-3.0-or-later

// What happens when two rough particles touch: they rotate, and their surfaces grip.
//
// Model of M. Huthmann and A. Zippelius, Phys. Rev. E 56, R6275 (1997), cond-mat/9708093, for
// particles of any masses. Spheres a and b with angular velocities omega touch; n is the unit
// vector from a to b, mu their reduced mass. The relative velocity of their surfaces is
//   g = v_a - v_b + (sigma_a/2 omega_a + sigma_b/2 omega_b) x n,
// of which the normal part g_n becomes -e g_n and the tangential part g_t becomes -beta g_t:
//   v_a* = v_a - (mu/m_a) [(1+e) g_n + 2 eta g_t],   w_a* = w_a - (mu/m_a) (2 eta/q) n x g_t,
//   v_b* = v_b + (mu/m_b) [the same],                w_b* = w_b - (mu/m_b) (the same),
//   w = (sigma/2) omega,   eta = q (1+beta) / (2 (1+q)),
// with beta from -1 (smooth) to 1 (perfectly rough) and q = 4 I / (m sigma^2), the same for either
// species: 2/5 for solid spheres, 1/2 for solid disks. Momentum and angular momentum are conserved;
// the energy lost is
//   (mu/2) (1-e^2) g_n^2 + (mu/2) q/(1+q) (1-beta^2) g_t^2.
// Disks rotate about the axis perpendicular to their plane: n x g_t has only this component, and so
// have their spins.
//
// A spin is stored as w, a speed of the surface, scaled like the velocities; the kinetic energy of
// rotation is (m/2) q w^2. Spins are stored by id in an array of their own because only a collision
// needs them. If a state holds no spins, all spins start at zero.
#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "engine/collision/smooth_collision.hpp"
#include "engine/restitution/any_restitution_model.hpp"
#include "engine/support/huge_vector.hpp"

namespace haff::engine {

inline Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <class PairGeometry = HardSpheres>
class RoughCollision : public SmoothCollision<AnyRestitutionModel, PairGeometry> {
  using Smooth = SmoothCollision<AnyRestitutionModel, PairGeometry>;

 public:
  // Throws std::invalid_argument if the model lacks a parameter of roughness.
  explicit RoughCollision(const Model& model, PairGeometry geometry = PairGeometry())
      : Smooth(AnyRestitutionModel(model), std::move(geometry)) {
    const Parameters& roughness = model.effects.at("roughness");
    q_ = positive(roughness, "q");
    const auto found = roughness.find("beta");
    if (found == roughness.end() || !(found->second >= -1 && found->second <= 1))
      throw std::invalid_argument("the model needs beta from -1 to 1");
    beta_ = found->second;
    eta_ = q_ * (1 + beta_) / (2 * (1 + q_));
  }

  template <class AnyClock>
  [[gnu::always_inline]] double collide(Particle& a, Particle& b, double now, const Box& box,
                                        AnyClock& clock) {
    const auto [r, v, approach, distance2] = this->resolve(a, b, now, box, clock);
    Vector& a_spin = spin_[a.id];
    Vector& b_spin = spin_[b.id];
    const double distance = std::sqrt(distance2);
    Vector n, spins;
    for (std::size_t k = 0; k < 3; ++k) {
      n[k] = r[k] / distance;
      spins[k] = a_spin[k] + b_spin[k];
    }
    const Vector turning = cross(spins, n);
    const double normal = approach / distance;
    Vector slip;  // -g_t: exchanging a and b negates it, like r and v
    for (std::size_t k = 0; k < 3; ++k) slip[k] = v[k] - normal * n[k] - turning[k];
    const Vector twist = cross(n, slip);

    const ReducedMass mass(this->masses(), a, b);
    for (std::size_t k = 0; k < 3; ++k) {
      const double change = 2 * eta_ * slip[k];
      a.velocity[k] += mass.in_a * change;
      b.velocity[k] -= mass.in_b * change;
      const double spun = 2 * eta_ / q_ * twist[k];
      a_spin[k] += mass.in_a * spun;
      b_spin[k] += mass.in_b * spun;
    }
    clock.tally.dissipated +=
        0.5 * mass.value * q_ / (1 + q_) * (1 - beta_ * beta_) * dot(slip, slip);
    return approach;
  }

  void recall(const State& state) {
    Smooth::recall(state);
    spin_.assign(state.id.size(), Vector{});
    exponent_ = state.exponent;
    const auto found = state.memory.find(key);
    if (found == state.memory.end()) return;
    if (found->second.size() != 3 * spin_.size())
      throw std::invalid_argument("the state remembers spins of other particles");
    for (std::size_t i = 0; i < spin_.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) spin_[i][k] = found->second[3 * i + k];
    if (state.d == 2 && std::any_of(spin_.begin(), spin_.end(),
                                    [](const Vector& w) { return w[0] != 0 || w[1] != 0; }))
      throw std::invalid_argument("the state has disks that rotate about an axis in their plane");
  }
  void store(State& state) const {
    Smooth::store(state);
    std::vector<double>& all = state.memory[key];
    for (const Vector& w : spin_) all.insert(all.end(), w.begin(), w.end());
  }

  void scale(int exponent) {
    Smooth::scale(exponent);
    if (exponent != exponent_) {
      const double factor = std::ldexp(1.0, exponent - exponent_);
      for (Vector& w : spin_)
        for (double& component : w) component *= factor;
    }
    exponent_ = exponent;
    energy_before_ = energy();
  }

  // The data beside the records that a collision changes, to undo it.
  struct Memento {
    std::uint32_t a, b;  // ids
    Vector spin_of_a, spin_of_b;
  };
  Memento memento(const Particle& a, const Particle& b) const {
    return {a.id, b.id, spin_[a.id], spin_[b.id]};
  }
  void restore(const Memento& before) {
    spin_[before.a] = before.spin_of_a;
    spin_[before.b] = before.spin_of_b;
  }

  std::optional<Rotation> rotation() const { return Rotation{energy_before_, energy()}; }
  std::size_t memory() const { return spin_.capacity() * sizeof(Vector); }

 private:
  static constexpr const char* key = "spin";

  double energy() const {
    double sum = 0;
    for (std::uint32_t id = 0; id < spin_.size(); ++id)
      sum += this->masses().of(id) * dot(spin_[id], spin_[id]);
    return 0.5 * q_ * sum / static_cast<double>(spin_.size());
  }

  double q_;
  double beta_;
  double eta_;
  int exponent_ = 0;          // true spin = spin * 2^-exponent
  double energy_before_ = 0;  // energy of rotation per particle at the last synchronization
  HugeVector<Vector> spin_;   // by id
};

}  // namespace haff::engine
