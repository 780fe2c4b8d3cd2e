// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/direct/direct_simulation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "analysis/direct/random.hpp"
#include "analysis/theory/cooling.hpp"
#include "analysis/theory/enskog.hpp"

namespace haff::analysis {

double nominal_restitution(const Restitution& law) {
  return std::visit(
      [](const auto& each) {
        if constexpr (requires { each.e; }) return each.e;
        return 0.0;
      },
      law);
}

namespace {

using Velocity = std::array<double, 3>;

// The largest relative speed that is tried, in units of sqrt(2 T), the standard deviation of each
// of its components. Faster pairs are always accepted, and thus a little too rarely: one pair in
// 10^8 in a Gaussian gas.
constexpr double fastest = 6.5;

// The interval after which the energy, from which the largest speed follows, and the scale are
// computed again; T changes by less than 2 % in between. [collisions per particle]
constexpr double round_length = 1.0 / 16;

// The interval between kicks of a thermostat. Kicks come halfway between its multiples, so that T
// and a_2 at the multiples are those of continuous noise to second order. [collisions per particle]
constexpr double kick_period = 1.0 / 16;

// Velocities are scaled by a power of two when T has fallen so far that v^12 would underflow soon.
constexpr int coldest_exponent = -40;  // of T

// Pairs drawn per particle for the mean loss and rate of one sample: more pairs would add no
// information, since the number of particles is finite.
constexpr int pairs_per_particle = 1;

// Control variates. v and v^3 of a pair are nearly linear in v^2 and v^4, whose means over all
// pairs are known exactly: with T = 1, v = square v^2 + fourth v^4 + rest, and only the mean of the
// rest has to be taken from the pairs drawn. The coefficients are least squares for Gaussian
// velocities; others would be right as well. They reduce the variance that drawing pairs adds to
// 2 % (v) and 0.2 % (v^3).
struct Control {
  double square, fourth;
};
template <int d>
struct Controls;
template <>
struct Controls<3> {
  static constexpr double root = std::numbers::inv_sqrtpi;
  static constexpr Control speed{root / 2, -root / 120}, cube{4 * root, root / 5};
  static constexpr double normal_share = 1.0 / 2;  // <v_n^2> / v^2 over impact parameters
};
template <>
struct Controls<2> {
  static constexpr double root = 1 / std::numbers::inv_sqrtpi;
  static constexpr Control speed{3 * root / 16, -root / 256}, cube{9 * root / 8, 9 * root / 128};
  static constexpr double normal_share = 2.0 / 3;
};

template <int d>
class Realization {
 public:
  Realization(const HomogeneousGas& gas, std::uint32_t particles, std::uint64_t seed,
              std::uint64_t stream)
      : random_(seed, stream),
        heating_(gas.heating),
        pair_rate_((d == 2 ? 2 : std::numbers::pi) * contact_value(gas.n, d) * gas.n),
        velocity_(particles),
        last_(particles) {
    for (Velocity& v : velocity_) {
      const auto [x, y] = random_.normal();
      v = {x, y, d == 3 ? random_.normal()[0] : 0};
    }
    start();
  }

  // Runs until the particles have collided tau times each on average.
  template <class Law>
  void advance(const Law& law, double tau) {
    const auto wanted = static_cast<std::int64_t>(std::llround(tau * count() / 2));
    while (collisions_ < wanted) {
      const std::int64_t next_round = from_rounds(static_cast<double>(round_ + 1), round_length);
      const std::int64_t next_kick =
          heating_ > 0 ? from_rounds(static_cast<double>(kick_) + 0.5, kick_period) : wanted;
      collide(law, std::min({wanted, next_round, next_kick}));
      if (collisions_ == next_round) {
        ++round_;
        set_trial_rate();
      }
      if (heating_ > 0 && collisions_ == next_kick) {
        ++kick_;
        kick();
      }
    }
  }

  template <class Law>
  DirectSample sample(const Law& law, double nominal) {
    const Moments now = moments(velocity_, d);
    DirectSample result{
        .time = time_, .temperature = now.temperature * unit_ * unit_, .laguerre = now.laguerre};
    using Known = Controls<d>;
    const double unit2 = now.temperature, unit = std::sqrt(unit2);  // of v^2 and v
    const double lost_share = (1 - nominal * nominal) * Known::normal_share;
    double speeds = 0, losses = 0;
    const auto pairs = static_cast<std::int64_t>(velocity_.size()) * pairs_per_particle;
    for (std::int64_t pair = 0; pair < pairs; ++pair) {
      const auto [i, j] = draw();
      if (i == j) continue;
      const double v2 = square(difference(i, j)) / unit2;
      const double v = std::sqrt(v2);
      speeds += v - v2 * (Known::speed.square + Known::speed.fourth * v2);
      // Combines the normal components of a head-on and of a glancing collision: the impact
      // parameter is uniform in the disk (on the line, for disks), and both b and its opposite are
      // taken.
      const double b = random_.uniform();
      losses +=
          v * 0.5 * (loss(law, v * unit, b, i, j) + loss(law, v * unit, 1 - b, i, j)) / unit2 -
          lost_share * v2 * (Known::cube.square + Known::cube.fourth * v2);
    }
    const auto [mean2, mean4] = mean_of_pairs(now);
    const auto drawn = static_cast<double>(pairs);
    speeds = speeds / drawn + Known::speed.square * mean2 + Known::speed.fourth * mean4;
    losses =
        losses / drawn + lost_share * (Known::cube.square * mean2 + Known::cube.fourth * mean4);
    // A particle does not collide with itself: 1/N of all draws.
    const double gaussian_speed = std::sqrt(d == 2 ? std::numbers::pi : 16 / std::numbers::pi);
    result.rate_ratio = speeds / gaussian_speed / (1 - 1 / count());
    // <v_n^2> of collisions in a Gaussian gas is 4 T.
    result.gamma_ratio = nominal > 0 && nominal < 1
                             ? losses / speeds / ((1 - nominal * nominal) * 4)
                             : std::numeric_limits<double>::quiet_NaN();
    return result;
  }

 private:
  double count() const { return static_cast<double>(velocity_.size()); }

  std::int64_t from_rounds(double rounds, double length) const {
    return static_cast<std::int64_t>(std::llround(rounds * length * count() / 2));
  }

  // Sets momentum to zero, E to 1 and the clocks to zero; no particle has collided yet.
  void start() {
    remove_momentum();
    const double scale = std::sqrt(2.0 / d / moments(velocity_, d).temperature);
    for (Velocity& v : velocity_)
      for (double& component : v) component *= scale;
    unit_ = 1;
    time_ = last_kick_ = 0;
    collisions_ = round_ = kick_ = 0;
    last_.assign(last_.size(), -std::numeric_limits<double>::infinity());
    set_trial_rate();
  }

  void remove_momentum() {
    Velocity sum{};
    for (const Velocity& v : velocity_)
      for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += v[axis];
    for (Velocity& v : velocity_)
      for (std::size_t axis = 0; axis < 3; ++axis) v[axis] -= sum[axis] / count();
  }

  // Sets the largest speed and the time between trials according to the present temperature.
  void set_trial_rate() {
    double temperature = moments(velocity_, d).temperature;
    if (std::ilogb(temperature) < coldest_exponent) {
      const int up = -std::ilogb(temperature) / 2;
      for (Velocity& v : velocity_)
        for (double& component : v) component = std::ldexp(component, up);
      unit_ = std::ldexp(unit_, -up);
      temperature = std::ldexp(temperature, 2 * up);
    }
    top_speed_ = fastest * std::sqrt(2 * temperature);
    between_trials_ = 2 / (count() * pair_rate_ * top_speed_ * unit_);
  }

  std::array<std::size_t, 2> draw() {
    const std::uint64_t bits = random_.bits();
    const auto among = [this](std::uint64_t word) {
      return static_cast<std::size_t>((word * velocity_.size()) >> 32);
    };
    return {among(bits >> 32), among(bits & 0xffffffffu)};
  }

  Velocity difference(std::size_t i, std::size_t j) const {
    const Velocity& a = velocity_[i];
    const Velocity& b = velocity_[j];
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  }

  static double square(const Velocity& v) { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; }

  // A direction, uniform on the unit sphere (circle), from a point in the ball as J. von Neumann
  // did.
  Velocity direction() {
    for (;;) {
      Velocity r{};
      for (int axis = 0; axis < d; ++axis)
        r[static_cast<std::size_t>(axis)] = 2 * random_.uniform() - 1;
      const double r2 = square(r);
      if (r2 > 1 || r2 < 1e-4) continue;  // smaller vectors would be rounded coarsely
      const double inverse = 1 / std::sqrt(r2);
      for (double& component : r) component *= inverse;
      return r;
    }
  }

  // Means of v^2/T and v^4/T^2 over all i and j, v = v_i - v_j, including i = j:
  //   <v^2> = 2 <v_i^2>,   <v^4> = 2 <v_i^4> + 2 <v_i^2>^2 + 4 sum_ab <v_ia v_ib>^2,
  // at zero momentum.
  std::array<double, 2> mean_of_pairs(const Moments& now) const {
    std::array<std::array<double, d>, d> tensor{};
    for (const Velocity& v : velocity_)
      for (std::size_t a = 0; a < d; ++a)
        for (std::size_t b = 0; b <= a; ++b) tensor[a][b] += v[a] * v[b];
    double squares = 0;
    for (std::size_t a = 0; a < d; ++a) {
      for (std::size_t b = 0; b <= a; ++b) {
        const double mean = tensor[a][b] / (count() * now.temperature);
        squares += (a == b ? 1 : 2) * mean * mean;
      }
    }
    const double fourth = d * (d + 2) * (1 + now.laguerre[2]);  // <v_i^4>
    return {2.0 * d, 2 * fourth + 2.0 * d * d + 4 * squares};
  }

  double age(std::size_t i, std::size_t j) const { return time_ - std::max(last_[i], last_[j]); }

  // (1 - e^2) v_n^2 of a collision at speed v. v_n^2 = v^2 (1 - b^2) with b^2 uniform (b for
  // disks).
  template <class Law>
  double loss(const Law& law, double v, double b, std::size_t i, std::size_t j) const {
    const double normal2 = v * v * (d == 2 ? 1 - b * b : 1 - b);
    const double e = law(std::sqrt(normal2) * unit_, age(i, j));
    return (1 - e * e) * normal2;
  }

  template <class Law>
  void collide(const Law& law, std::int64_t until) {
    const double top2 = top_speed_ * top_speed_;
    while (collisions_ < until) {
      time_ += between_trials_;
      const auto [i, j] = draw();
      const double share = random_.uniform();
      const Velocity v = difference(i, j);
      const double speed2 = square(v);
      if (share * share * top2 >= speed2) continue;
      Velocity n{};
      double normal = 0;
      do {
        n = direction();
        normal = v[0] * n[0] + v[1] * n[1] + v[2] * n[2];
      } while (std::abs(normal) < random_.uniform() * std::sqrt(speed2));
      const double e = law(std::abs(normal) * unit_, age(i, j));
      const double change = 0.5 * (1 + e) * normal;
      for (std::size_t axis = 0; axis < d; ++axis) {
        velocity_[i][axis] -= change * n[axis];
        velocity_[j][axis] += change * n[axis];
      }
      last_[i] = last_[j] = time_;
      ++collisions_;
    }
  }

  // Adds the white noise since the last kick, without that of the centre of mass.
  void kick() {
    const double variance = 2 * heating_ / d * (time_ - last_kick_) * count() / (count() - 1);
    const double width = std::sqrt(variance) / unit_;
    last_kick_ = time_;
    for (Velocity& v : velocity_)
      for (int axis = 0; axis < d; ++axis)
        v[static_cast<std::size_t>(axis)] += width * random_.nearly_normal();
    remove_momentum();
    set_trial_rate();
  }

  Random random_;
  double heating_;
  double pair_rate_;  // chi n sigma^(d-1) c_d
  std::vector<Velocity> velocity_;
  std::vector<double> last_;  // time of the last collision
  double unit_ = 1;           // the true velocity that a stored 1 stands for
  double time_ = 0;
  double last_kick_ = 0;
  double top_speed_ = 0;
  double between_trials_ = 0;
  std::int64_t collisions_ = 0;
  std::int64_t round_ = 0;
  std::int64_t kick_ = 0;
};

template <int d, class Law>
std::vector<DirectSample> run(Realization<d> realization, const Law& law, double nominal,
                              std::span<const double> tau) {
  std::vector<DirectSample> samples;
  for (const double each : tau) {
    realization.advance(law, each);
    samples.push_back(realization.sample(law, nominal));
  }
  return samples;
}

// The mean of one member over realizations, at one tau or over several.
template <class Of>
Estimate mean_of(const DirectRealizations& realizations, std::size_t first, std::size_t last,
                 const Of& of) {
  std::vector<double> values;
  for (const auto& samples : realizations) {
    double sum = 0;
    for (std::size_t k = first; k < last; ++k) sum += of(samples[k]);
    values.push_back(sum / static_cast<double>(last - first));
  }
  return estimate(values);
}

DirectPoint point_of(const DirectRealizations& realizations, std::size_t first, std::size_t last) {
  const auto mean = [&](const auto& of) { return mean_of(realizations, first, last, of); };
  DirectPoint point{
      .time = mean([](const DirectSample& s) { return s.time; }),
      .temperature = mean([](const DirectSample& s) { return s.temperature; }),
      .gamma_ratio = mean([](const DirectSample& s) { return s.gamma_ratio; }),
      .rate_ratio = mean([](const DirectSample& s) { return s.rate_ratio; }),
  };
  for (std::size_t l = 0; l < point.laguerre.size(); ++l)
    point.laguerre[l] = mean([l](const DirectSample& s) { return s.laguerre[l]; });
  return point;
}

}  // namespace

std::vector<DirectSample> direct_realization(const HomogeneousGas& gas, std::span<const double> tau,
                                             std::uint32_t particles, std::uint64_t seed,
                                             std::uint64_t stream) {
  if (particles < 2) throw std::invalid_argument("direct simulation: at least two particles");
  if (gas.d != 2 && gas.d != 3)
    throw std::invalid_argument("direct simulation: dimension must be 2 or 3");
  const double nominal = nominal_restitution(gas.law);
  if (!(nominal >= 0 && nominal <= 1 && gas.heating >= 0 && gas.n > 0))
    throw std::invalid_argument("direct simulation: 0 <= e <= 1, n > 0 and heating >= 0");
  double last = 0;
  for (const double each : tau) {
    if (!(each >= last)) throw std::invalid_argument("direct simulation: tau must not decrease");
    last = each;
  }
  return std::visit(
      [&](const auto& law) {
        return gas.d == 2 ? run(Realization<2>(gas, particles, seed, stream), law, nominal, tau)
                          : run(Realization<3>(gas, particles, seed, stream), law, nominal, tau);
      },
      gas.law);
}

DirectRealizations direct_realizations(const HomogeneousGas& gas, std::span<const double> tau,
                                       const SimulationSize& size) {
  if (size.realizations < 2)
    throw std::invalid_argument("direct simulation: an error takes two realizations");
  DirectRealizations all;
  for (std::uint32_t k = 0; k < size.realizations; ++k)
    all.push_back(direct_realization(gas, tau, size.particles, size.seed, k));
  return all;
}

std::vector<DirectPoint> direct_means(const DirectRealizations& realizations) {
  std::vector<DirectPoint> points;
  for (std::size_t k = 0; k < realizations.front().size(); ++k)
    points.push_back(point_of(realizations, k, k + 1));
  return points;
}

DirectPoint direct_plateau(const DirectRealizations& realizations, std::size_t first) {
  return point_of(realizations, first, realizations.front().size());
}

}  // namespace haff::analysis
