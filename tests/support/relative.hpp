// SPDX-License-Identifier: GPL-3.0-or-later

// Relative differences, to say which are allowed. doctest's Approx(x).epsilon(eps) allows
// eps (1 + |x|), which for a small x is far more than eps says.
#pragma once

#include <cmath>

namespace haff::tests {

// |value/expected - 1|
inline double off(double value, double expected) {
  return std::abs(value / expected - 1);
}

}  // namespace haff::tests
