// SPDX-License-Identifier: GPL-3.0-or-later

// A gas driven by white noise: the noise replaces the energy lost in collisions, and the gas
// reaches a steady state.
//
// T. P. C. van Noije and M. H. Ernst, Granular Matter 1, 57 (1998), cond-mat/9803042: every
// particle feels a random acceleration <xi_a(t) xi_b(t')> = xi_0^2 delta_ab delta(t - t'). It gives
// each particle on average the energy `rate` = d <m> xi_0^2 / 2 per unit of time [E(0) / (sigma
// sqrt(m/E(0)))]. In a mixture both species feel the same accelerations, as if the container were
// shaken, as in S. R. Dahl, C. M. Hrenya, V. Garzo and J. W. Dufty, Phys. Rev. E 66, 041301 (2002),
// cond-mat/0205413.
//
// The noise acts as kicks: normal deviates with the variance that the noise would have added since
// the last kick. The kick of the centre of mass is subtracted, so the total momentum is conserved.
#pragma once

#include <cmath>
#include <stdexcept>
#include <string_view>

#include "engine/actions/action.hpp"

namespace haff::engine {

// Between kicks the gas cools freely: it loses the fraction 2 gamma_0 kick_period of its energy,
// 3 % at e = 0.8. Samples are taken at multiples of the period and kicks come halfway between them,
// so that T and a_2 in the samples agree with those of continuous noise to second order, within
// 1e-3. [collisions/particle]
inline constexpr double kick_period = 0.25;

class Thermostat : public Action {
 public:
  static constexpr std::string_view name = "thermostat";

  Thermostat(const Parameters& parameters, std::uint64_t seed, const State& start)
      : rate_(positive(parameters, "rate")),
        seed_(seed),
        d_(start.d),
        mixture_(mixture_in(start)),
        last_(start.time) {
    const auto found = start.memory.find(key);
    if (found == start.memory.end()) return;
    if (found->second.size() != 1)
      throw std::invalid_argument("the state does not hold one time of the last kick");
    last_ = found->second.front();
  }

  std::int64_t next(std::int64_t collisions, std::size_t particles) const override {
    return next_at(collisions, particles, kick_period, 0.5);
  }

  void act(std::span<Particle> particles, const Clock& clock) override {
    if (mixture_)
      kick(particles, clock, MixedMasses{*mixture_});
    else
      kick(particles, clock, EqualMasses{});
  }

  void store(State& state) const override { state.memory[key] = {last_}; }

 private:
  static constexpr const char* key = "last_kick";

  template <class Masses>
  void kick(std::span<Particle> particles, const Clock& clock, const Masses& masses) {
    const double mass = masses.of_all(particles.size());
    double squares = 0;
    for (const Particle& p : particles) squares += masses.of(p) * masses.of(p);
    const double variance =
        2 * rate_ * static_cast<double>(particles.size()) / (d_ * mass) * (clock.time() - last_);
    last_ = clock.time();
    // Compensates for the variance that subtracting the centre of mass removes.
    const double width =
        std::ldexp(std::sqrt(variance * mass / (mass - squares / mass)), clock.exponent);
    Random random(seed_, Stream::thermostat, static_cast<std::uint64_t>(clock.collisions));
    for (Particle& p : particles)
      for (double& v : std::span(p.velocity).first(static_cast<std::size_t>(d_)))
        v += width * random.normal();
    remove_momentum(particles, masses);
  }

  double rate_;
  std::uint64_t seed_;
  int d_;
  std::optional<Mixture> mixture_;
  double last_;  // time of the last kick [sigma sqrt(m/E(0))]
};

}  // namespace haff::engine
