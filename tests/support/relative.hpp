// SPDX-License-Identifier: GPL-3.0-or-later

// Relative differences, to say what is allowed. doctest's Approx(x).epsilon(eps) allows
// eps (1 + |x|): of a small x far more than the eps that stands there.
#pragma once

#include <cmath>

namespace haff::tests {

// |value/expected - 1|
inline double off(double value, double expected) {
  return std::abs(value / expected - 1);
}

}  // namespace haff::tests
