// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/observables/fourier.hpp"

#include <cmath>
#include <new>

namespace haff::analysis {
namespace {

constexpr unsigned flags = FFTW_ESTIMATE | FFTW_NO_SIMD;

template <class T>
T* allocated(std::size_t count) {
  void* memory = fftw_malloc(count * sizeof(T));
  if (memory == nullptr) throw std::bad_alloc();
  return static_cast<T*>(memory);
}

bool is_smooth(int number) {
  for (const int prime : {2, 3, 5})
    while (number % prime == 0) number /= prime;
  return number == 1;
}

}  // namespace

Fourier::Fourier(const Mesh& mesh)
    : mesh_(mesh),
      field_(allocated<double>(mesh_.size())),
      modes_(allocated<std::complex<double>>(mode_count())) {
  const std::array<int, 3> sides{mesh.cells, mesh.cells, mesh.cells};
  auto* modes = reinterpret_cast<fftw_complex*>(modes_.get());  // as FFTW's manual advises
  forward_.reset(fftw_plan_dft_r2c(mesh.d, sides.data(), field_.get(), modes, flags));
  backward_.reset(fftw_plan_dft_c2r(mesh.d, sides.data(), modes, field_.get(), flags));
  if (!forward_ || !backward_) throw std::bad_alloc();
}

int transform_cells(double smallest_cells) {
  constexpr double most = 128;
  int cells = std::max(1, static_cast<int>(std::min(most, smallest_cells)));
  while (!is_smooth(cells)) --cells;
  return cells;
}

}  // namespace haff::analysis
