// Elastic spheres against the equation of state of N. F. Carnahan and K. E. Starling
// (J. Chem. Phys. 51, 635 (1969)): virial pressure and collision frequency.
#include <doctest/doctest.h>

#include <cmath>

#include "analysis/theory/enskog.hpp"
#include "engine/initial.hpp"
#include "engine/simulation.hpp"

using namespace haff;

TEST_CASE("pressure and collision rate of the elastic fluid") {
  constexpr std::uint32_t particles = 4000;
  // 2e5 collisions: the virial sum has a standard error near 0.2 %; the equation itself is good to
  // 0.3 % in this range and finite size to 0.1 %.
  constexpr double tolerance = 0.008;
  for (const double n : {0.1, 0.4, 0.8}) {
    CAPTURE(n);
    engine::Simulation gas({.restitution = 1}, engine::initial_state(n, particles, 1));
    gas.run_to(engine::collisions_at(50, particles));
    gas.take_tally();
    const double start = gas.time();
    gas.run_to(engine::collisions_at(150, particles));
    const double duration = gas.time() - start;

    constexpr double temperature = 2.0 / 3;
    const double pressure =
        n * temperature + gas.take_tally().virial * n / (3 * particles * duration);
    const double rate = 100 / duration;
    CHECK(pressure / (n * temperature) ==
          doctest::Approx(analysis::equation_of_state(n).z).epsilon(tolerance));
    CHECK(rate ==
          doctest::Approx(analysis::transport(n, temperature).collision_rate).epsilon(tolerance));
  }
}
