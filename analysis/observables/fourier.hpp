// SPDX-License-Identifier: GPL-3.0-or-later

// Discrete Fourier transform of a real field on a periodic mesh, by FFTW. For the .cpp files of
// this room only.
//
// The plan is estimated, not measured, and uses neither wisdom, threads nor SIMD codelets. Equal
// fields then have equal transforms, to the last bit, on any processor and at any time.
#pragma once

#include <fftw3.h>

#include <array>
#include <complex>
#include <memory>
#include <span>

#include "analysis/observables/mesh.hpp"

namespace haff::analysis {

class Fourier {
 public:
  explicit Fourier(const Mesh& mesh);

  // The field, with cells as in Mesh, and its transform sum_x f(x) exp(-ikx), with modes as in
  // FFTW: along the last axis only 0 ... cells/2. Each transform overwrites its input.
  std::span<double> field() { return {field_.get(), mesh_.size()}; }
  std::span<std::complex<double>> modes() { return {modes_.get(), mode_count()}; }

  void forward() { fftw_execute(forward_.get()); }
  void backward() { fftw_execute(backward_.get()); }  // without the factor 1/size

  // Calls visit(mode number, wave numbers (a, b, c) of -cells/2 ... cells/2, weight), where weight
  // is the number of modes that this one stands for: 2 where its complex conjugate is left out.
  template <class Visit>
  void for_each_mode(Visit&& visit) const {
    const int half = mesh_.cells / 2 + 1;
    const int planes = mesh_.d == 3 ? mesh_.cells : 1;
    std::size_t number = 0;
    for (int i = 0; i < planes; ++i)
      for (int j = 0; j < mesh_.cells; ++j)
        for (int k = 0; k < half; ++k, ++number) {
          const int weight = k == 0 || 2 * k == mesh_.cells ? 1 : 2;
          visit(number, std::array<int, 3>{folded(i), folded(j), k}, weight);
        }
  }

 private:
  // For d = 2 the first axis is empty: wave numbers are (0, a, b).
  int folded(int i) const { return 2 * i > mesh_.cells ? i - mesh_.cells : i; }
  std::size_t mode_count() const {
    const auto side = static_cast<std::size_t>(mesh_.cells);
    return mesh_.size() / side * (side / 2 + 1);
  }

  struct Free {
    void operator()(void* memory) const { fftw_free(memory); }
    void operator()(fftw_plan plan) const { fftw_destroy_plan(plan); }
  };
  using Plan = std::unique_ptr<std::remove_pointer_t<fftw_plan>, Free>;

  Mesh mesh_;
  std::unique_ptr<double, Free> field_;
  std::unique_ptr<std::complex<double>, Free> modes_;
  Plan forward_, backward_;
};

// The side of the smallest box [sigma] with two shells of wave numbers.
constexpr double smallest_spectral_box = 8;

// The number of cells along an axis of a mesh for transforms, from the number of smallest cells
// that fit: at most 128 (then an array takes 17 MB), and one for which FFTW is fast (2^a 3^b 5^c).
int transform_cells(double smallest_cells);

}  // namespace haff::analysis
