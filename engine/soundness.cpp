// SPDX-License-Identifier: GPL-3.0-or-later

#include "engine/soundness.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "engine/mixture.hpp"
#include "engine/particles/box.hpp"

namespace haff::engine {
namespace {

// Text formatted as by printf().
template <class... Value>
std::string text(const char* format, Value... value) {
  std::array<char, 200> buffer;
  std::snprintf(buffer.data(), buffer.size(), format, value...);
  return buffer.data();
}

double distance2(const Vector& a, const Vector& b, double box) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    double r = b[k] - a[k];
    r -= std::nearbyint(r / box) * box;
    sum += r * r;
  }
  return sum;
}

// Particles sorted into cells that are no smaller than a diameter: overlapping particles are at
// most one cell apart.
class Cells {
 public:
  explicit Cells(const State& state) : state_(state) {
    // More cells than particles would gain nothing, however dilute the gas is.
    const double particles = state.particles();
    const double most = (state.d == 2 ? std::sqrt(particles) : std::cbrt(particles)) + 1;
    side_ = static_cast<int>(std::max(1.0, std::floor(std::min(state.box, most))));
    layers_ = state.d == 2 ? 1 : side_;
    const auto side = static_cast<std::size_t>(side_);
    begin_.resize(side * side * static_cast<std::size_t>(layers_) + 1);
    for (const Vector& r : state.position) ++begin_[cell_of(r) + 1];
    for (std::size_t c = 1; c < begin_.size(); ++c) begin_[c] += begin_[c - 1];
    members_.resize(state.position.size());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t i = 0; i < members_.size(); ++i)
      members_[next[cell_of(state.position[i])]++] = i;
  }

  // Calls visit(i, j) for every pair in the same cell or in neighbouring cells; for some pairs
  // twice.
  template <class Visit>
  void for_each_pair(Visit&& visit) const {
    const int reach = side_ < 3 ? side_ - 1 : 1;
    const int reach_z = layers_ == 1 ? 0 : reach;
    for (std::size_t i = 0; i < members_.size(); ++i) {
      const auto home = coordinates(state_.position[i]);
      for (int x = -reach; x <= reach; ++x)
        for (int y = -reach; y <= reach; ++y)
          for (int z = -reach_z; z <= reach_z; ++z) {
            const std::size_t c = index({home[0] + x, home[1] + y, home[2] + z});
            for (std::size_t k = begin_[c]; k < begin_[c + 1]; ++k)
              if (i < members_[k]) visit(i, members_[k]);
          }
    }
  }

 private:
  using Coordinates = std::array<int, 3>;

  Coordinates coordinates(const Vector& r) const {
    Coordinates cell{};
    for (std::size_t k = 0; k < 3; ++k)
      cell[k] = std::min(side_ - 1, static_cast<int>(r[k] / state_.box * side_));
    return cell;
  }
  std::size_t index(Coordinates cell) const {
    for (int& c : cell) c = (c + side_) % side_;
    const auto side = static_cast<std::size_t>(side_);
    return (static_cast<std::size_t>(cell[2]) * side + static_cast<std::size_t>(cell[0])) * side +
           static_cast<std::size_t>(cell[1]);
  }
  std::size_t cell_of(const Vector& r) const { return index(coordinates(r)); }

  const State& state_;
  int side_ = 1;
  int layers_ = 1;  // along z
  std::vector<std::size_t> begin_;
  std::vector<std::size_t> members_;
};

bool is_finite(const Vector& v) {
  return std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); });
}

std::optional<std::string> unsound_mixture(const State& state) {
  const auto mixture = mixture_in(state);
  if (!mixture || (mixture->first > 0 && mixture->first < state.particles() &&
                   mixture->diameter > 0 && mixture->diameter <= 1 && mixture->mass > 0))
    return std::nullopt;
  return text(
      "a mixture of %u particles, the others of diameter %g and mass %g (0 to 1 and above "
      "0 expected)",
      mixture->first, mixture->diameter, mixture->mass);
}

std::optional<std::string> unsound_numbers(const State& state) {
  if (state.d != 2 && state.d != 3) return text("dimension %d (2 or 3 expected)", state.d);
  const std::size_t particles = state.id.size();
  if (particles < 2 || state.position.size() != particles || state.velocity.size() != particles)
    return text("%zu ids, %zu positions and %zu velocities do not make a gas", particles,
                state.position.size(), state.velocity.size());
  if (!std::isfinite(state.box) || state.box < smallest_box)
    return text("box side %.6g (at least %g sigma expected)", state.box, smallest_box);
  if (state.collisions < 0 || !std::isfinite(state.time) || state.time < 0)
    return text("time %g after %lld collisions", state.time,
                static_cast<long long>(state.collisions));
  if (!std::isfinite(state.tally.dissipated) || !std::isfinite(state.tally.virial))
    return "a sum over collisions is not finite";
  for (const auto& [name, values] : state.memory)
    for (const double value : values)
      if (std::isnan(value)) return name + " holds a value that is not a number";

  std::vector<bool> seen(particles);
  for (std::size_t i = 0; i < particles; ++i) {
    const std::uint32_t id = state.id[i];
    if (id >= particles || seen[id]) return text("particle id %u twice or too large", id);
    seen[id] = true;
    if (!is_finite(state.velocity[i]) || !is_finite(state.position[i]))
      return text("particle %u: position or velocity is not finite", id);
    for (const double x : state.position[i])
      if (x < 0 || x >= state.box)
        return text("particle %u: position %.17g outside the box [0, %.17g)", id, x, state.box);
    if (state.d == 2 && (state.position[i][2] != 0 || state.velocity[i][2] != 0))
      return text("disk %u has left its plane: z = %g, v_z = %g", id, state.position[i][2],
                  state.velocity[i][2]);
  }
  return unsound_mixture(state);
}

std::optional<std::string> deepest_overlap(const State& state) {
  const double allowed = allowed_overlap(state.particles() / Box(state).volume(), 1, state.d);
  const double closest2 = (1 - allowed) * (1 - allowed);
  const auto mixture = mixture_in(state);
  double least2 = closest2;
  std::pair<std::size_t, std::size_t> pair;
  Cells(state).for_each_pair([&](std::size_t i, std::size_t j) {
    double r2 = distance2(state.position[i], state.position[j], state.box);
    if (mixture) {  // in units of the contact distance
      const double contact = mixture->contact_distance(state.id[i], state.id[j]);
      r2 /= contact * contact;
    }
    if (r2 < least2) {
      least2 = r2;
      pair = {i, j};
    }
  });
  if (least2 == closest2) return std::nullopt;
  return text("particles %u and %u overlap by %.3g sigma (%.0e allowed)", state.id[pair.first],
              state.id[pair.second], 1 - std::sqrt(least2), allowed);
}

}  // namespace

std::optional<std::string> unsoundness(const State& state) {
  if (auto wrong = unsound_numbers(state)) return wrong;
  return deepest_overlap(state);
}

double allowed_overlap(double n, double periods, int d) {
  const double mean_free_path = 1 / (std::numbers::sqrt2 * (d == 2 ? 2 : std::numbers::pi) * n);
  const double flight = 30 * mean_free_path * std::max(periods, 1.0);
  return smallest_allowed_overlap + std::numeric_limits<double>::epsilon() * flight * flight;
}

double largest_overlap(const Invariants& invariants) {
  return 1 - std::sqrt(invariants.closest2);
}

std::optional<std::string> violation(const Invariants& invariants, double allowed_overlap) {
  const double overlap = largest_overlap(invariants);
  if (!(overlap <= allowed_overlap))
    return text("particles overlapped by %.3g sigma when they collided (%.0e allowed)", overlap,
                allowed_overlap);
  if (!(invariants.energy_mismatch <= allowed_energy_mismatch))
    return text(
        "the loss in collisions and the change of kinetic energy differ by %.3g of that "
        "energy (%.0e allowed)",
        invariants.energy_mismatch, allowed_energy_mismatch);
  if (!(invariants.momentum_removed <= allowed_momentum))
    return text("the total momentum had grown to %.3g of sqrt(N) rms speeds (%.0e allowed)",
                invariants.momentum_removed, allowed_momentum);
  return std::nullopt;
}

}  // namespace haff::engine
