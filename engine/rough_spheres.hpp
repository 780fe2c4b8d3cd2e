// Rough spheres: they rotate, and their surfaces grip.
//
// Model as in M. Huthmann and A. Zippelius, Phys. Rev. E 56, R6275 (1997), cond-mat/9708093.
// Spheres a and b with angular velocities omega touch, n the unit vector from a to b. Of the
// velocity of their surfaces relative to each other,
//   g = v_a - v_b + (sigma/2) (omega_a + omega_b) x n,
// the normal part g_n changes to -e g_n and the tangential part g_t to -beta g_t:
//   v_a* = v_a - (1+e)/2 g_n - eta g_t,     omega_a* = omega_a - 2 eta/(q sigma) n x g_t,
//   v_b* = v_b + the same,                  omega_b* = omega_b - the same,
//   eta = q (1+beta) / (2 (1+q)),
// with beta from -1 (smooth) to 1 (perfectly rough) and q = 4 I / (m sigma^2), 2/5 for solid
// spheres. Momentum and angular momentum are conserved; the energy lost is
//   m/4 (1-e^2) g_n^2 + m/4 q/(1+q) (1-beta^2) g_t^2.
//
// Spins are kept as w = (sigma/2) omega, a speed of the surface, scaled like the velocities; the
// kinetic energy of rotation is (m/2) q w^2. They lie beside the records, by id: only a collision
// needs them. A gas whose state remembers none starts at rest.
#pragma once

#include <cmath>
#include <stdexcept>
#include <vector>

#include "engine/any_law.hpp"
#include "engine/memory.hpp"

namespace haff::engine {

inline Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

class RoughSpheres : public HardSpheres, public OneOfAKind {
 public:
  // Throws std::invalid_argument if the model lacks a parameter of roughness.
  explicit RoughSpheres(const Model& model) : law_(model) {
    const Parameters& roughness = model.effects.at("roughness");
    q_ = positive(roughness, "q");
    const auto found = roughness.find("beta");
    if (found == roughness.end() || !(found->second >= -1 && found->second <= 1))
      throw std::invalid_argument("the model needs beta from -1 to 1");
    beta_ = found->second;
    eta_ = q_ * (1 + beta_) / (2 * (1 + q_));
  }

  [[gnu::always_inline]] double collide(Particle& a, Particle& b, double now, const Box& box,
                                        Clock& clock) {
    const double a_time = a.time;
    const double b_time = b.time;
    advance(a, now);
    advance(b, now);
    const Encounter contact(a, b, now, box);
    const double approach = dot(contact.r, contact.v);
    const double distance2 = dot(contact.r, contact.r);
    const double e = law_({a, b, a_time, b_time, now, approach * approach / distance2});
    Vector& a_spin = spin_[a.id];
    Vector& b_spin = spin_[b.id];
    const double distance = std::sqrt(distance2);
    Vector n, spins;
    for (std::size_t k = 0; k < 3; ++k) {
      n[k] = contact.r[k] / distance;
      spins[k] = a_spin[k] + b_spin[k];
    }
    const Vector turning = cross(spins, n);
    const double normal = approach / distance;
    Vector slip;  // -g_t: swapping a and b negates it, as it does r and v
    for (std::size_t k = 0; k < 3; ++k) slip[k] = contact.v[k] - normal * n[k] - turning[k];
    const Vector twist = cross(n, slip);

    exchange(a, b, contact, 0.5 * (1 + e) * approach / distance2);
    for (std::size_t k = 0; k < 3; ++k) {
      const double change = eta_ * slip[k];
      a.velocity[k] += change;
      b.velocity[k] -= change;
      const double spun = eta_ / q_ * twist[k];
      a_spin[k] += spun;
      b_spin[k] += spun;
    }
    clock.tally.virial -= 0.5 * (1 + e) * approach;
    clock.tally.dissipated += 0.25 * (1 - e * e) * approach * approach / distance2 +
                              0.25 * q_ / (1 + q_) * (1 - beta_ * beta_) * dot(slip, slip);
    clock.invariants.closest2 = std::min(clock.invariants.closest2, distance2);
    return approach;
  }

  void recall(const State& state) {
    law_.recall(state);
    spin_.assign(state.id.size(), Vector{});
    exponent_ = state.exponent;
    const auto found = state.memory.find(key);
    if (found == state.memory.end()) return;
    if (found->second.size() != 3 * spin_.size())
      throw std::invalid_argument("the state remembers spins of other particles");
    for (std::size_t i = 0; i < spin_.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) spin_[i][k] = found->second[3 * i + k];
  }
  void store(State& state) const {
    law_.store(state);
    std::vector<double>& all = state.memory[key];
    for (const Vector& w : spin_) all.insert(all.end(), w.begin(), w.end());
  }

  void before_synchronization(std::span<const Particle> particles, double now) {
    law_.before_synchronization(particles, now);
  }
  void scale(int exponent) {
    law_.scale(exponent);
    if (exponent != exponent_) {
      const double factor = std::ldexp(1.0, exponent - exponent_);
      for (Vector& w : spin_)
        for (double& component : w) component *= factor;
    }
    exponent_ = exponent;
    energy_before_ = energy();
  }

  std::optional<Rotation> rotation() const { return Rotation{energy_before_, energy()}; }
  std::size_t memory() const { return spin_.capacity() * sizeof(Vector); }

 private:
  static constexpr const char* key = "spin";

  double energy() const {
    double sum = 0;
    for (const Vector& w : spin_) sum += dot(w, w);
    return 0.5 * q_ * sum / static_cast<double>(spin_.size());
  }

  AnyLaw law_;
  double q_;
  double beta_;
  double eta_;
  int exponent_ = 0;          // true spin = spin * 2^-exponent
  double energy_before_ = 0;  // of rotation per particle, at the last synchronization
  HugeVector<Vector> spin_;   // by id
};

}  // namespace haff::engine
