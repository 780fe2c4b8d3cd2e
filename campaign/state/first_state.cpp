// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/state/first_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <vector>

#include "campaign/state/model.hpp"
#include "engine/initial.hpp"
#include "engine/mixture.hpp"
#include "engine/soundness.hpp"

namespace haff::campaign {
namespace {

using engine::Vector;

// sin(2 pi x), by Taylor's series in a quarter of a period, to 1e-16. The sine of the C library
// differs in its last bit between machines, and the trajectory would, too.
double sine_of_turns(double x) {
  constexpr double pi = 3.14159265358979323846;
  constexpr int terms = 11;  // (pi/2)^23 / 23! < 1e-17
  x -= std::floor(x);
  const double sign = x < 0.5 ? 1 : -1;
  if (x >= 0.5) x -= 0.5;
  if (x > 0.25) x = 0.5 - x;
  const double angle = 2 * pi * x;
  double term = angle, sum = angle;
  for (int k = 1; k <= terms; ++k) {
    term *= -angle * angle / ((2.0 * k) * (2.0 * k + 1));
    sum += term;
  }
  return sign * sum;
}

class Masses {
 public:
  explicit Masses(const engine::State& state) : mixture_(mixture_in(state)) {}
  double of(std::uint32_t id) const { return mixture_ ? mixture_->mass_of(id) : 1; }
  bool is_second(std::uint32_t id) const { return mixture_ && mixture_->is_second(id); }
  bool are_two() const { return mixture_.has_value(); }

 private:
  std::optional<engine::Mixture> mixture_;
};

double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// The energy per particle; with two fields of velocities, their product in its place.
double energy(const engine::State& state, const Masses& masses, const std::vector<Vector>& one,
              const std::vector<Vector>& other) {
  double sum = 0;
  for (std::size_t k = 0; k < state.id.size(); ++k)
    sum += 0.5 * masses.of(state.id[k]) * dot(one[k], other[k]);
  return sum / state.particles();
}

// The mean velocity, weighted with masses, of those particles that `belongs` chooses.
template <class Belongs>
Vector mean_velocity(const engine::State& state, const Masses& masses, Belongs&& belongs) {
  Vector momentum{};
  double mass = 0;
  for (std::size_t k = 0; k < state.id.size(); ++k) {
    if (!belongs(k)) continue;
    const double m = masses.of(state.id[k]);
    mass += m;
    for (std::size_t axis = 0; axis < 3; ++axis) momentum[axis] += m * state.velocity[k][axis];
  }
  for (double& component : momentum) component /= mass;
  return momentum;
}

template <class Belongs>
void take_away(const Vector& velocity, engine::State& state, Belongs&& belongs) {
  for (std::size_t k = 0; k < state.id.size(); ++k)
    if (belongs(k))
      for (std::size_t axis = 0; axis < 3; ++axis) state.velocity[k][axis] -= velocity[axis];
}

constexpr auto all = [](std::size_t) { return true; };

void add_shear_wave(const schema::Start& start, engine::State& state) {
  const Masses masses(state);
  const std::vector<Vector> thermal = state.velocity;
  for (std::size_t k = 0; k < state.id.size(); ++k)
    state.velocity[k] = {
        start.amplitude * sine_of_turns(start.waves * (state.position[k][1] / state.box)), 0, 0};
  take_away(mean_velocity(state, masses, all), state, all);
  const std::vector<Vector> wave = state.velocity;
  // f^2 thermal + 2 f mixed + of_wave = 1
  const double of_thermal = energy(state, masses, thermal, thermal);
  const double mixed = energy(state, masses, thermal, wave);
  const double of_wave = energy(state, masses, wave, wave);
  const double f = (std::sqrt(mixed * mixed + of_thermal * (1 - of_wave)) - mixed) / of_thermal;
  for (std::size_t k = 0; k < state.id.size(); ++k)
    for (std::size_t axis = 0; axis < 3; ++axis)
      state.velocity[k][axis] = f * thermal[k][axis] + wave[k][axis];
}

void set_two_temperatures(const schema::Start& start, engine::State& state) {
  const Masses masses(state);
  const auto is_first = [&](std::size_t k) {
    return masses.are_two() ? !masses.is_second(state.id[k])
                            : state.position[k][0] < 0.5 * state.box;
  };
  const auto is_second = [&](std::size_t k) { return !is_first(k); };
  std::array<double, 2> count{}, energies{};
  take_away(mean_velocity(state, masses, is_first), state, is_first);
  take_away(mean_velocity(state, masses, is_second), state, is_second);
  for (std::size_t k = 0; k < state.id.size(); ++k) {
    const std::size_t group = is_first(k) ? 0 : 1;
    ++count[group];
    energies[group] += 0.5 * masses.of(state.id[k]) * dot(state.velocity[k], state.velocity[k]);
  }
  if (!(energies[0] > 0 && energies[1] > 0))
    throw std::invalid_argument(
        "two temperatures: one of the two groups has too few particles; expected a larger N");
  // The energy per particle of each group; the energies of all particles add up to N.
  const double second = (count[0] + count[1]) / (count[0] * start.ratio + count[1]);
  const std::array<double, 2> wanted{second * start.ratio, second};
  std::array<double, 2> factor{};
  for (std::size_t group = 0; group < 2; ++group)
    factor[group] = std::sqrt(wanted[group] * count[group] / energies[group]);
  for (std::size_t k = 0; k < state.id.size(); ++k)
    for (double& v : state.velocity[k]) v *= factor[is_first(k) ? 0 : 1];
}

// ---- a state of the user's own ----------------------------------------------------------------

// Lengths and masses may differ from those of the job by digits that a file left out. [relative]
constexpr double written_out = 1e-6;

bool is_near(double value, double expected) {
  return std::abs(value - expected) <= written_out * expected;
}

void must_fit(bool condition, const std::string& what) {
  if (!condition) throw std::invalid_argument(what);
}

// The ids of the file if they are those of this gas, otherwise ids in its order, species 1 first.
std::vector<std::uint32_t> ids_of(const Frame& frame,
                                  const std::optional<engine::Mixture>& mixture) {
  const std::size_t count = frame.position.size();
  std::vector<bool> is_second(count);
  for (std::size_t k = 0; k < count; ++k)
    is_second[k] = mixture && (frame.species[k] == "He" || frame.species[k] == "2");
  const auto seconds = static_cast<std::size_t>(std::ranges::count(is_second, true));
  if (mixture)
    must_fit(count - seconds == mixture->first,
             fmt::format("{} particles are of species 2 (He), and {} expected, as the fraction of "
                         "the mixture says",
                         seconds, count - mixture->first));
  bool are_own = frame.id.size() == count;
  std::vector<bool> seen(count);
  for (std::size_t k = 0; are_own && k < count; ++k) {
    const std::uint32_t id = frame.id[k];
    are_own = id < count && !seen[id] && (!mixture || mixture->is_second(id) == is_second[k]);
    if (are_own) seen[id] = true;
  }
  if (are_own) return frame.id;
  std::vector<std::uint32_t> ids(count);
  std::uint32_t next = 0;
  for (const bool second : {false, true})
    for (std::size_t k = 0; k < count; ++k)
      if (is_second[k] == second) ids[k] = next++;
  return ids;
}

void check_sizes(const Frame& frame, const std::vector<std::uint32_t>& ids,
                 const std::optional<engine::Mixture>& mixture) {
  for (std::size_t k = 0; k < ids.size(); ++k) {
    const double radius = 0.5 * (mixture ? mixture->diameter_of(ids[k]) : 1);
    const double mass = mixture ? mixture->mass_of(ids[k]) : 1;
    must_fit(
        frame.radius.empty() || is_near(frame.radius[k], radius),
        fmt::format("line {}: radius {}, and {} expected: lengths are in diameters of species 1",
                    k + 3, frame.radius.empty() ? 0 : frame.radius[k], radius));
    must_fit(frame.mass.empty() || is_near(frame.mass[k], mass),
             fmt::format("line {}: mass {}, and {} expected", k + 3,
                         frame.mass.empty() ? 0 : frame.mass[k], mass));
  }
}

double into_box(double x, double box) {
  x -= std::floor(x / box) * box;
  return x < 0 || x >= box ? 0 : x;  // rounding
}

}  // namespace

engine::State first_state(const engine::State& equilibrated, const schema::Start& start) {
  if (start.kind == schema::Start::Kind::file) return equilibrated;
  engine::State state = engine::restarted(equilibrated);
  if (start.kind == schema::Start::Kind::shear_wave) add_shear_wave(start, state);
  if (start.kind == schema::Start::Kind::two_temperatures) set_two_temperatures(start, state);
  return state;
}

engine::State given_state(const Frame& frame, const schema::Job& job) {
  const double box = engine::box_side(job.n, job.particles, job.d);
  must_fit(frame.position.size() == job.particles,
           fmt::format("holds {} particles, and the grid asks for {}", frame.position.size(),
                       job.particles));
  for (int axis = 0; axis < job.d; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    must_fit(is_near(frame.side[k], box),
             fmt::format("its cell has a side of {}, and N = {} at n = {} have {}: write n as {}",
                         frame.side[k], job.particles, job.n, box,
                         job.particles / std::pow(frame.side[k], job.d)));
    must_fit(frame.is_periodic[k], "its cell is not periodic (pbc) along each axis");
  }
  const auto mixture = mixture_of(job);
  engine::State state;
  state.d = job.d;
  state.box = box;
  state.id = ids_of(frame, mixture);
  check_sizes(frame, state.id, mixture);
  if (mixture) note(*mixture, state);
  for (std::size_t k = 0; k < frame.position.size(); ++k) {
    Vector r{}, v{};
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(job.d); ++axis) {
      r[axis] = into_box(frame.position[k][axis] - frame.origin[axis], box);
      v[axis] = frame.velocity[k][axis];
    }
    must_fit(job.d == 3 || frame.velocity[k][2] == 0,
             fmt::format("line {}: a disk moves along z", k + 3));
    state.position.push_back(r);
    state.velocity.push_back(v);
  }
  const Masses masses(state);
  take_away(mean_velocity(state, masses, all), state, all);
  double sum = energy(state, masses, state.velocity, state.velocity);
  const auto q = job.effects.parameter("roughness", "q");
  std::vector<double> spins;
  if (q && !frame.angular_velocity.empty()) {
    spins.resize(3 * state.id.size());
    double rotation = 0;
    for (std::size_t k = 0; k < state.id.size(); ++k) {
      // A gas keeps the speed of the surface.
      const double radius = 0.5 * (mixture ? mixture->diameter_of(state.id[k]) : 1);
      Vector w = frame.angular_velocity[k];
      for (double& component : w) component *= radius;
      must_fit(job.d == 3 || (w[0] == 0 && w[1] == 0),
               fmt::format("line {}: a disk turns out of its plane", k + 3));
      for (std::size_t axis = 0; axis < 3; ++axis) spins[3 * state.id[k] + axis] = w[axis];
      rotation += 0.5 * masses.of(state.id[k]) * *q * dot(w, w);
    }
    sum += rotation / state.particles();
  }
  must_fit(std::isfinite(sum) && sum > 0,
           "its particles do not move against each other: it has no energy to be 1");
  const double factor = std::sqrt(1 / sum);
  for (Vector& v : state.velocity)
    for (double& component : v) component *= factor;
  for (double& spin : spins) spin *= factor;
  if (!spins.empty()) state.memory["spin"] = std::move(spins);
  if (const auto wrong = unsoundness(state)) throw std::invalid_argument(*wrong);
  return state;
}

}  // namespace haff::campaign
