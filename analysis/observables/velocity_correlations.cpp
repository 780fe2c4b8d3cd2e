// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/observables/velocity_correlations.hpp"

#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>

#include "analysis/observables/fourier.hpp"

namespace haff::analysis {
namespace {

constexpr double fewest_cells = 4;  // along an axis

using Modes = std::vector<std::complex<double>>;

// Sums over shells of separations |R| = s - 1/2 ... s + 1/2 cells, s = 1 ... cells/2.
class Shells {
 public:
  explicit Shells(const Mesh& mesh) : mesh_(mesh), count_(mesh.cells / 2) {
    const int half = mesh.cells / 2 + 1;
    for (int square = 0; square <= mesh.d * half * half; ++square)
      shell_of_square_.push_back(static_cast<int>(std::lround(std::sqrt(square))));
  }

  int count() const { return count_; }

  // The sum of field(R) weight(R) over the R of each shell.
  template <class Weight>
  std::vector<double> sums(std::span<const double> field, Weight&& weight) const {
    std::vector<double> sums(static_cast<std::size_t>(count_));
    const int planes = mesh_.d == 3 ? mesh_.cells : 1;
    std::size_t number = 0;
    for (int i = 0; i < planes; ++i)
      for (int j = 0; j < mesh_.cells; ++j)
        for (int k = 0; k < mesh_.cells; ++k, ++number) {
          // The axes of a plane are its last two, as in Fourier.
          const std::array<int, 3> R{folded(i), folded(j), folded(k)};
          const int square = R[0] * R[0] + R[1] * R[1] + R[2] * R[2];
          const int shell = shell_of_square_[static_cast<std::size_t>(square)];
          if (shell >= 1 && shell <= count_)
            sums[static_cast<std::size_t>(shell - 1)] += field[number] * weight(R, square);
        }
    return sums;
  }

 private:
  int folded(int i) const { return 2 * i > mesh_.cells ? i - mesh_.cells : i; }

  Mesh mesh_;
  int count_;
  std::vector<int> shell_of_square_;
};

double one(const std::array<int, 3>& /*R*/, int /*square*/) {
  return 1;
}

// Momentum in each cell, component by component, and the number of particles there.
class Cells {
 public:
  Cells(const Mesh& mesh, std::span<const Vector> position, std::span<const Vector> velocity)
      : velocity_(velocity) {
    cell_.reserve(position.size());
    for (const Vector& r : position)
      cell_.push_back(static_cast<std::uint32_t>(mesh.number(mesh.cell_of(r))));
  }

  Modes momentum(Fourier& fourier, std::size_t axis) const {
    return transform(fourier, [&](std::size_t i) { return velocity_[i][axis]; });
  }
  Modes number(Fourier& fourier) const {
    return transform(fourier, [](std::size_t) { return 1.0; });
  }

 private:
  template <class Value>
  Modes transform(Fourier& fourier, Value&& value) const {
    const auto field = fourier.field();
    std::fill(field.begin(), field.end(), 0.0);
    for (std::size_t i = 0; i < cell_.size(); ++i) field[cell_[i]] += value(i);
    fourier.forward();
    const auto modes = fourier.modes();
    return {modes.begin(), modes.end()};
  }

  std::span<const Vector> velocity_;
  std::vector<std::uint32_t> cell_;
};

// The even part of the correlation of two fields over all separations, left in fourier.field().
void correlate(Fourier& fourier, const Modes& a, const Modes& b, double size) {
  const auto modes = fourier.modes();
  for (std::size_t k = 0; k < modes.size(); ++k)
    modes[k] = (a[k].real() * b[k].real() + a[k].imag() * b[k].imag()) / size;
  fourier.backward();
}

// sin x / x, where x is the phase across half a cell.
double window(int wave, int cells) {
  if (wave == 0) return 1;
  const double x = std::numbers::pi * wave / cells;
  return std::sin(x) / x;
}

double trace(const Fourier& fourier, const std::vector<Modes>& momentum, const Mesh& mesh,
             std::span<const Vector> velocity, double k_max) {
  double self = 0;
  for (const Vector& v : velocity)
    for (std::size_t axis = 0; axis < momentum.size(); ++axis) self += v[axis] * v[axis];
  const double k_unit = 2 * std::numbers::pi / mesh.box;
  double sum = 0;
  fourier.for_each_mode([&](std::size_t number, const std::array<int, 3>& k, int weight) {
    const int square = k[0] * k[0] + k[1] * k[1] + k[2] * k[2];
    if (square == 0 || k_unit * std::sqrt(square) > k_max) return;
    double power = 0;
    for (const Modes& component : momentum) power += std::norm(component[number]);
    double cell = 1;
    for (const int wave : k) cell *= window(wave, mesh.cells);
    sum += weight * (power - self) / (cell * cell);
  });
  const auto count = static_cast<double>(velocity.size());
  return sum / (count * count);
}

}  // namespace

VelocityCorrelations velocity_correlations(std::span<const Vector> position,
                                           std::span<const Vector> velocity, double box,
                                           double k_max, int d, double cell) {
  if (position.size() != velocity.size() || position.size() < 2 || !(box > fewest_cells * cell))
    throw std::invalid_argument(
        "velocity correlations need as many positions as velocities and a box of 4 cells");
  const Mesh mesh{.box = box, .cells = transform_cells(box / cell), .d = d};
  const auto size = static_cast<double>(mesh.size());
  const auto axes = static_cast<std::size_t>(d);
  const Shells shells(mesh);
  const Cells cells(mesh, position, velocity);
  Fourier fourier(mesh);

  const Modes number = cells.number(fourier);
  correlate(fourier, number, number, size);
  const auto pairs = shells.sums(fourier.field(), one);

  std::vector<Modes> momentum;
  for (std::size_t a = 0; a < axes; ++a) momentum.push_back(cells.momentum(fourier, a));
  std::vector<double> along(pairs.size()), all(pairs.size());
  for (std::size_t a = 0; a < axes; ++a)
    for (std::size_t b = a; b < axes; ++b) {
      correlate(fourier, momentum[a], momentum[b], size);
      const std::size_t shift = 3 - axes;  // for d = 2 the first component of R is empty
      const double times = a == b ? 1 : 2;
      const auto projected =
          shells.sums(fourier.field(), [&](const std::array<int, 3>& R, int square) {
            return times * R[a + shift] * R[b + shift] / square;
          });
      for (std::size_t s = 0; s < along.size(); ++s) along[s] += projected[s];
      if (a != b) continue;
      const auto diagonal = shells.sums(fourier.field(), one);
      for (std::size_t s = 0; s < all.size(); ++s) all[s] += diagonal[s];
    }

  VelocityCorrelations result;
  result.trace = trace(fourier, momentum, mesh, velocity, k_max);
  const std::vector<double> ones(mesh.size(), 1.0);
  const auto separations = shells.sums(ones, one);
  const auto distances = shells.sums(
      ones, [](const std::array<int, 3>& /*R*/, int square) { return std::sqrt(square); });
  for (std::size_t s = 0; s < pairs.size(); ++s) {
    const double count = std::round(pairs[s]);
    if (count < 1) continue;  // in a gas of a few particles
    result.r.push_back(mesh.cell_side() * distances[s] / separations[s]);
    result.parallel.push_back(along[s] / count);
    result.perpendicular.push_back((all[s] - along[s]) / count / (d - 1));
  }
  return result;
}

}  // namespace haff::analysis
