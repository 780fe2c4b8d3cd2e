// SPDX-License-Identifier: GPL-3.0-or-later

// Measured correlations, compared with sums over all pairs, with a shear mode whose correlations
// are known in closed form, and with velocities that have none.
#include "analysis/observables/velocity_correlations.hpp"

#include <doctest/doctest.h>

#include <stdexcept>

#include "analysis/particles.hpp"

using namespace haff::analysis;
using doctest::Approx;
using std::numbers::pi;

namespace {

// v_y = sin(k x) on a lattice with one particle in each cell of the transform.
std::vector<Vector> shear(const std::vector<Vector>& position, double k) {
  std::vector<Vector> velocity;
  for (const Vector& r : position) velocity.push_back({0, std::sin(k * r[0]), 0});
  return velocity;
}

// The same shells by brute force: every pair, at the nearest image of its cells.
VelocityCorrelations by_pairs(const std::vector<Vector>& position,
                              const std::vector<Vector>& velocity, const Mesh& mesh) {
  std::vector<double> pairs(static_cast<std::size_t>(mesh.cells / 2 + 1)), along(pairs), all(pairs);
  for (std::size_t i = 0; i < position.size(); ++i)
    for (std::size_t j = 0; j < position.size(); ++j) {
      const auto a = mesh.cell_of(position[i]), b = mesh.cell_of(position[j]);
      double square = 0, va = 0, vb = 0, dot = 0;
      for (std::size_t axis = 0; axis < static_cast<std::size_t>(mesh.d); ++axis) {
        int R = (a[axis] - b[axis] + mesh.cells) % mesh.cells;
        if (2 * R > mesh.cells) R -= mesh.cells;
        square += R * R;
        va += R * velocity[i][axis];
        vb += R * velocity[j][axis];
        dot += velocity[i][axis] * velocity[j][axis];
      }
      const auto shell = static_cast<std::size_t>(std::lround(std::sqrt(square)));
      if (shell < 1 || shell >= pairs.size()) continue;
      ++pairs[shell];
      along[shell] += va * vb / square;
      all[shell] += dot;
    }
  VelocityCorrelations g;
  for (std::size_t s = 1; s < pairs.size(); ++s) {
    g.parallel.push_back(along[s] / pairs[s]);
    g.perpendicular.push_back((all[s] - along[s]) / pairs[s] / (mesh.d - 1));
  }
  return g;
}

}  // namespace

TEST_CASE("velocity correlations: the same as sums over all pairs") {
  for (const int d : {2, 3}) {
    CAPTURE(d);
    Random random(5);
    const double box = 9.3;                  // 9 cells: an odd number
    for (const double wide : {box, 10.9}) {  // and 10 cells
      const auto position = random_positions(700, wide, random);
      const auto velocity = thermal_velocities(700, random);
      const Mesh mesh{.box = wide, .cells = static_cast<int>(wide), .d = d};
      const auto fast = velocity_correlations(position, velocity, wide, 1, d);
      const auto slow = by_pairs(position, velocity, mesh);
      REQUIRE(fast.parallel.size() == slow.parallel.size());
      for (std::size_t s = 0; s < slow.parallel.size(); ++s) {
        if (2 * (s + 1) == static_cast<std::size_t>(mesh.cells)) continue;  // see below
        CHECK(fast.parallel[s] == Approx(slow.parallel[s]).epsilon(1e-11));
        CHECK(fast.perpendicular[s] == Approx(slow.perpendicular[s]).epsilon(1e-11));
      }
    }
  }
}

TEST_CASE("velocity correlations: those of a shear wave are known in closed form") {
  // <v_y(r) v_y(r + R)> = cos(k R_x) / 2. Averaged over directions, with y = k R:
  // Tr G = sin y / 2y, G_par = <(R_y/R)^2 cos(k R_x)> / 2 = (sin y - y cos y) / 2y^3.
  constexpr int cells = 32;
  const auto position = lattice(cells, cells, 3);
  const double k = 2 * pi / cells;
  const auto g = velocity_correlations(position, shear(position, k), cells, 1);
  // Separations on a lattice are not spread evenly over directions: the first shell has 6 and 12 of
  // them (which gives an error of 0.006), the last one thousands.
  constexpr double uneven = 0.008;
  REQUIRE(g.r.size() == cells / 2);
  for (std::size_t s = 0; s < g.r.size(); ++s) {
    const double y = k * g.r[s];
    const double trace = std::sin(y) / (2 * y);
    const double parallel = (std::sin(y) - y * std::cos(y)) / (2 * y * y * y);
    CHECK(std::abs(g.parallel[s] - parallel) < uneven);
    CHECK(std::abs(g.perpendicular[s] - (trace - parallel) / 2) < uneven);
  }
}

TEST_CASE("velocity correlations: the trace of a shear wave is its energy") {
  // <v^2> = 1/2 in two modes +-k, minus their share of the self part, 2/N of <v^2>. The wave is
  // seen through cells, hence the division by sinc^2.
  constexpr int cells = 16;
  const auto position = lattice(cells, 16, 3);
  const double k = 2 * pi / 16;
  const double sinc = std::sin(pi / cells) / (pi / cells);
  const double N = cells * cells * cells;
  const auto g = velocity_correlations(position, shear(position, k), 16, 1.01 * k);
  // Six modes are within k_max: two carry the wave, and the self part of all six is subtracted.
  CHECK(g.trace == Approx((0.5 - 6 * 0.5 / N) / (sinc * sinc)).epsilon(1e-12));
  CHECK(velocity_correlations(position, shear(position, k), 16, 0.99 * k).trace == 0);
}

TEST_CASE("velocity correlations: independent velocities have none") {
  // 40 000 uncorrelated velocities, T = 1: every point and the trace are within 4.5 standard
  // errors. Of some 50 numbers, one strays in one of 3000 seeds.
  constexpr double strays = 4.5;
  Random random(1);
  constexpr std::size_t count = 40000;
  const double box = 46.4;
  const auto position = random_positions(count, box, random);
  const auto velocity = thermal_velocities(count, random);
  const auto g = velocity_correlations(position, velocity, box, 1.0);
  REQUIRE(g.r.size() == 22);
  for (std::size_t s = 0; s < g.r.size(); ++s) {
    const double cell = box / 45, width = cell;
    const double pairs = 0.5 * count * count * 4 * pi * g.r[s] * g.r[s] * width / (box * box * box);
    CHECK(std::abs(g.parallel[s]) < strays / std::sqrt(pairs));
    CHECK(std::abs(g.perpendicular[s]) < strays / std::sqrt(2 * pairs));
  }
  const double modes = 4 * pi / 3 * std::pow(box / (2 * pi), 3);
  // Each pair of modes +-k has power 3 N T (1 +- 1/sqrt 3).
  CHECK(std::abs(g.trace) < strays * 2 * std::sqrt(3 * modes / 2) / count * 1.2);
}

TEST_CASE("velocity correlations: the same bits every time") {
  Random random(2);
  const auto position = random_positions(5000, 23.2, random);
  const auto velocity = thermal_velocities(5000, random);
  const auto one = velocity_correlations(position, velocity, 23.2, 1);
  const auto other = velocity_correlations(position, velocity, 23.2, 1);
  CHECK(one.parallel == other.parallel);
  CHECK(one.perpendicular == other.perpendicular);
  CHECK(one.trace == other.trace);
}

TEST_CASE("velocity correlations: bad input is refused") {
  const std::vector<Vector> two(2), three(3);
  CHECK_THROWS_AS(velocity_correlations(two, three, 10, 1), std::invalid_argument);
  CHECK_THROWS_AS(velocity_correlations(two, two, 3, 1), std::invalid_argument);
}
