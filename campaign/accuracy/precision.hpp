// What rounding does to results. The engine computes in double alone, whose rounding shifts too
// little to be seen; single precision, which rounds 2^29 times as coarsely, was measured beside it.
#pragma once

#include <cstdint>
#include <vector>

#include "campaign/accuracy/quantity.hpp"

namespace haff::campaign {

// The gas of the measurements.
inline constexpr double precision_e = 0.8, precision_n = 0.4;

// Mean in single less mean in double, of the same initial states (README, What accuracy costs).
struct PrecisionShift {
  Quantity quantity;
  std::uint32_t particles = 0;
  std::size_t realizations = 0;
  double value = 0;
  double error = 0;  // standard error of value
};

// What is known of a quantity: measurements of itself, or else of its measure in other windows.
std::vector<PrecisionShift> single_less_double(const Quantity& quantity);

}  // namespace haff::campaign
