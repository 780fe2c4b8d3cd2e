// SPDX-License-Identifier: GPL-3.0-or-later

// The restitution laws as the direct simulation uses them: e as a function of the normal relative
// speed v [sqrt(E(0)/m)] and of the time since either partner's previous collision [sigma
// sqrt(m/E(0))].
#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <variant>

namespace haff::analysis {

struct ConstantRestitution {
  double e = 1;
  double operator()(double /*v*/, double /*age*/) const { return e; }
};

// Elastic below a normal relative speed.
struct ThresholdRestitution {
  double e = 1;
  double speed = 0;
  double operator()(double v, double /*age*/) const { return v < speed ? 1 : e; }
};

// The TC model of S. Luding and S. McNamara, Granular Matter 1, 113 (1998): elastic if a partner's
// previous collision is less than t_c ago. In a homogeneous gas partners never meet twice in a row,
// so the effect comes from the Poisson statistics of collisions alone.
struct ContactDurationRestitution {
  double e = 1;
  double t_c = 0;
  double operator()(double /*v*/, double age) const { return age < t_c ? 1 : e; }
};

// R. Ramirez, T. Poeschel, N. V. Brilliantov and T. Schwager, Phys. Rev. E 60, 4465 (1999):
// e = 1 - x + (3/5) x^2, x = 1.15344 A v^(1/5). Throws std::domain_error beyond x = 5/3, where the
// series exceeds 1.
struct ViscoelasticRestitution {
  double A = 0;
  double operator()(double v, double /*age*/) const {
    const double x = 1.15344 * A * std::pow(v, 0.2);
    if (x > 5.0 / 3) throw std::domain_error("the viscoelastic law gives e > 1: A is too large");
    return 1 - x + 0.6 * x * x;
  }
};

// K. L. Johnson, Contact Mechanics (1985), sec. 11.5: e = (speed/v)^(1/4) above the yield speed,
// 1 below.
struct PlasticRestitution {
  double speed = 1;
  double operator()(double v, double /*age*/) const {
    return v <= speed ? 1 : std::sqrt(std::sqrt(speed / v));
  }
};

using Restitution =
    std::variant<ConstantRestitution, ThresholdRestitution, ContactDurationRestitution,
                 ViscoelasticRestitution, PlasticRestitution>;

// The e from which gamma_0 is computed; 0 for laws that decide e by the speed alone, which have
// none.
double nominal_restitution(const Restitution& law);

}  // namespace haff::analysis
