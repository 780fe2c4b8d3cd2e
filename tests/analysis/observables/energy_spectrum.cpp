// SPDX-License-Identifier: GPL-3.0-or-later

// Energy spectra of flows that are known, and of thermal velocities.
#include "analysis/observables/energy_spectrum.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

#include "analysis/particles.hpp"
#include "analysis/theory/spectrum.hpp"

using namespace haff::analysis;
using doctest::Approx;
using std::numbers::pi;

namespace {

// The energy of each shell: E is a density in k, here divided by the modes per particle.
double energy_of_shell(const EnergySpectrum& found, const std::vector<double>& spectrum,
                       std::size_t shell, double box, int d) {
  const double modes = (d == 3 ? 4 * pi * std::pow(found.k[shell], 2) : 2 * pi * found.k[shell]) *
                       std::pow(box / (2 * pi), d);
  return spectrum[shell] / modes;  // the mean energy of a mode
}

}  // namespace

TEST_CASE("energy_spectrum: a shear wave and a sound wave, on a lattice") {
  // v = cos(2 pi m x / L) along y or x, m = 2: two modes have N^2/4 each. Shell 2 has all modes
  // from 1.5 to 2.5: 86 in space, 12 in the plane. With a mesh point in each cell the only error is
  // the effect of sharing out on the carried wave, which is corrected except for the part that is
  // folded into the mode from the lattice itself, at most (pi m / 20)^2 / 3 of its amplitude.
  for (const int d : {2, 3}) {
    CAPTURE(d);
    const double box = 20;
    const auto position = lattice(20, box, d);
    std::vector<Vector> shear(position.size()), sound(position.size());
    for (std::size_t i = 0; i < position.size(); ++i) {
      const double wave = std::cos(2 * pi * 2 * position[i][0] / box);
      shear[i] = {0, wave, 0};
      sound[i] = {wave, 0, 0};
    }
    const double modes = d == 3 ? 62 : 12;     // counted by hand: squares 3 to 6
    const double each = 2 * 0.25 / 2 / modes;  // |p|^2/(2 N^2), averaged over the shell
    const auto of_shear = energy_spectrum(position, shear, {}, box, d);
    const auto of_sound = energy_spectrum(position, sound, {}, box, d);
    CHECK(energy_of_shell(of_shear, of_shear.transverse, 1, box, d) == Approx(each).epsilon(0.07));
    CHECK(std::abs(energy_of_shell(of_shear, of_shear.longitudinal, 1, box, d)) < 0.01 * each);
    CHECK(energy_of_shell(of_sound, of_sound.longitudinal, 1, box, d) ==
          Approx(each).epsilon(0.07));
    CHECK(std::abs(energy_of_shell(of_sound, of_sound.transverse, 1, box, d)) < 0.01 * each);
    // All energy of the shell is at k = 2 pi 2 / L.
    CHECK(of_shear.enstrophy[1] / of_shear.transverse[1] ==
          Approx(std::pow(2 * pi * 2 / box, 2)).epsilon(0.01));
  }
}

TEST_CASE("energy_spectrum: equipartition of thermal velocities") {
  // |p|^2 of a mode is a sum of d squares of Gaussians; half of the modes are independent. Shells 1
  // to 8, two spectra, within 4.5 standard errors: a false alarm in one of 5000 seeds.
  for (const int d : {2, 3}) {
    CAPTURE(d);
    Random random(8);
    const std::size_t count = 20000;
    const double box = d == 3 ? 36 : 200;
    const double n = static_cast<double>(count) / std::pow(box, d);
    const auto position = random_positions(count, box, random);
    const auto found = energy_spectrum(position, thermal_velocities(count, random), {}, box, d);
    REQUIRE(found.k.size() >= 8);
    for (std::size_t s = 0; s < 8; ++s) {
      const double shell = static_cast<double>(s) + 1;
      const double modes = d == 3 ? 4 * pi * shell * shell : 2 * pi * shell;
      const double along = equilibrium_spectrum(found.k[s], n, 1, true, d);
      const double across = equilibrium_spectrum(found.k[s], n, 1, false, d);
      CHECK(std::abs(found.longitudinal[s] / along - 1) < 4.5 * std::sqrt(2 / modes));
      CHECK(std::abs(found.transverse[s] / across - 1) < 4.5 * std::sqrt(2 / (modes * (d - 1))));
    }
  }
}

TEST_CASE("energy_spectrum: equipartition of particles of two masses") {
  Random random(9);
  const std::size_t count = 20000;
  auto velocity = thermal_velocities(count, random);
  std::vector<double> mass(count);
  for (std::size_t i = 0; i < count; ++i) {
    mass[i] = i % 2 == 0 ? 1 : 0.04;
    for (double& v : velocity[i]) v /= std::sqrt(mass[i]);
  }
  const auto position = random_positions(count, 36, random);
  const auto found = energy_spectrum(position, velocity, mass, 36);
  const double n = count / std::pow(36.0, 3);
  for (std::size_t s = 2; s < 8; ++s) {  // within 4.5 standard errors, as above
    const double shell = static_cast<double>(s) + 1;
    CHECK(std::abs(found.longitudinal[s] / equilibrium_spectrum(found.k[s], n, 1, true) - 1) <
          4.5 * std::sqrt(2 / (4 * pi * shell * shell)));
  }
}

TEST_CASE("energy_spectrum: arrays that do not belong together are refused") {
  const std::vector<Vector> two(2), three(3);
  CHECK_THROWS_AS(energy_spectrum(two, three, {}, 10), std::invalid_argument);
  CHECK_THROWS_AS(energy_spectrum(two, two, {}, 7), std::invalid_argument);
  CHECK_THROWS_AS(energy_spectrum(two, two, std::vector<double>(3), 10), std::invalid_argument);
}
