// SPDX-License-Identifier: GPL-3.0-or-later

// Structure factor and clusters of particles placed by hand and at random.
#include "analysis/observables/structure.hpp"

#include <doctest/doctest.h>

#include <complex>
#include <stdexcept>

#include "analysis/particles.hpp"

using namespace haff::analysis;
using doctest::Approx;
using std::numbers::pi;

namespace {

// Shells of modes by brute force.
std::vector<double> by_modes(const std::vector<Vector>& position, double box, int shells, int d) {
  std::vector<double> sum(static_cast<std::size_t>(shells)), count(sum);
  for (int a = -shells - 1; a <= shells + 1; ++a)
    for (int b = -shells - 1; b <= shells + 1; ++b)
      for (int c = d == 3 ? -shells - 1 : 0; c <= (d == 3 ? shells + 1 : 0); ++c) {
        const auto shell = std::lround(std::sqrt(a * a + b * b + c * c));
        if (shell < 1 || shell > shells) continue;
        std::complex<double> mode;
        for (const Vector& r : position)
          mode += std::polar(1.0, -2 * pi / box * (a * r[0] + b * r[1] + c * r[2]));
        sum[static_cast<std::size_t>(shell - 1)] +=
            std::norm(mode) / static_cast<double>(position.size());
        ++count[static_cast<std::size_t>(shell - 1)];
      }
  for (std::size_t s = 0; s < sum.size(); ++s) sum[s] /= count[s];
  return sum;
}

}  // namespace

TEST_CASE("structure: the sum over particles, mode by mode") {
  Random random(3);
  for (const int d : {2, 3}) {
    CAPTURE(d);
    auto position = random_positions(1000, 16, random);
    for (Vector& r : position) {  // density 1 + 0.8 cos(2 k_1 x)
      while (random.uniform() > (1 + 0.8 * std::cos(4 * pi * r[0] / 16)) / 1.8)
        r[0] = 16 * random.uniform();
      if (d == 2) r[2] = 0;
    }
    const auto measured = structure_factor(position, 16, d);
    const auto expected = by_modes(position, 16, 4, d);
    REQUIRE(measured.value.size() == 4);
    for (std::size_t s = 0; s < 4; ++s) {
      // In the last shell the mesh mixes into each mode another one of random phase, with up to 1/9
      // of its amplitude. This gives 2/9 of S, over the half of the modes that are independent.
      // Three times that is allowed, at fixed seeds.
      const double shell = static_cast<double>(s) + 1;
      const double modes = d == 3 ? 4 * pi * shell * shell : 2 * pi * shell;
      CHECK(std::abs(measured.value[s] - expected[s]) < 3 * (2.0 / 9) / std::sqrt(modes / 2));
    }
    CHECK(measured.k[0] > 2 * pi / 16);
    CHECK(measured.k[0] < 2 * pi / 16 * 1.5);
  }
}

TEST_CASE("structure: uncorrelated particles have S = 1") {
  // |mode|^2/N is exponential with variance 1, and half of the modes are independent: within 4.5
  // standard errors at 11 wave numbers, a false alarm in one of 13 000 seeds.
  Random random(4);
  const auto measured = structure_factor(random_positions(40000, 46.4, random), 46.4);
  REQUIRE(measured.value.size() == 11);
  for (std::size_t s = 0; s < measured.value.size(); ++s) {
    const double shell = static_cast<double>(s) + 1;
    const double modes = 4 * pi * shell * shell / 2;
    CHECK(std::abs(measured.value[s] - 1) < 4.5 / std::sqrt(modes));
  }
}

TEST_CASE("structure: S of a lattice is zero below its first peak") {
  const auto measured = structure_factor(lattice(16, 16, 3), 16);
  for (const double value : measured.value) CHECK(std::abs(value) < 0.1);  // folded-in peaks
}

TEST_CASE("clusters: the largest dense region is counted") {
  // 8 x 8 x 8 cells of 20 particles, and two regions of 3 and of 2 cells with 20 more particles in
  // each cell. One of the regions crosses the edge of the box.
  const double box = 32, cell = 4;
  for (int extra = 0; extra < 2; ++extra) {
    std::vector<Vector> position;
    const auto fill = [&](int i, int j, int k) {
      for (int p = 0; p < 20; ++p)
        position.push_back({cell * (i + 0.5), cell * (j + 0.5), cell * (k + 0.05 * p)});
    };
    for (int i = 0; i < 8; ++i)
      for (int j = 0; j < 8; ++j)
        for (int k = 0; k < 8; ++k) fill(i, j, k);
    const double homogeneous = largest_cluster(position, box);
    CHECK(homogeneous == 0);
    for (const int i : {7, 0, 1}) fill(i, 2, 2);
    for (const int k : {4, 5}) fill(4, 4, k);
    if (extra == 1) fill(3, 3, 4);  // shares an edge only
    // The particles are too few for another cell along an axis: 9^3 * 20 > N.
    CHECK(largest_cluster(position, box) == 3 * 40.0 / static_cast<double>(position.size()));
  }
}

TEST_CASE("clusters: particles at random positions have hardly any") {
  Random random(6);
  CHECK(largest_cluster(random_positions(100000, 62, random), 62) < 0.005);
}

TEST_CASE("structure: no particles and small boxes are refused") {
  const std::vector<Vector> none, one(1);
  CHECK_THROWS_AS(structure_factor(none, 10), std::invalid_argument);
  CHECK_THROWS_AS(structure_factor(one, 5), std::invalid_argument);
  CHECK_THROWS_AS(largest_cluster(none, 10), std::invalid_argument);
}
