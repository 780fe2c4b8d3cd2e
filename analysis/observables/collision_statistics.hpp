// SPDX-License-Identifier: GPL-3.0-or-later

// Statistics of collisions: densities of free times, of impact parameters and of normal speeds,
// from counts in bins of equal width that begin at zero. Theory: theory/collision_statistics.hpp.
//
// Each collision of an interval has two particles with a free time each, one impact parameter and
// one normal speed. A bin with n counts has a relative standard error of 1/sqrt(n) if they are
// independent; the standard error of a mean over realizations holds in any case.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace haff::analysis {

struct Density {
  std::vector<double> x;      // middle of each bin
  std::vector<double> value;  // mean over the bin: 1 everywhere if uniform on [0, 1]
};

// The density in all bins. Both arrays are empty if nothing was counted. Throws
// std::invalid_argument if there is no bin.
Density density(std::span<const std::int64_t> counts, double width);

// The same where the last bin holds all values beyond the others: they are counted, but the bin is
// left out.
Density density_with_rest(std::span<const std::int64_t> counts, double width);

// The density of free times 2k/N on the collision clock, k = 1, 2, ... collisions of a gas of N
// particles: with `per_unit` bins in a unit, bin i holds the k with floor(per_unit 2k/N) = i. Where
// N is small, or not a multiple of per_unit, bins do not have the same number of k; this is
// corrected.
Density density_of_free_times(std::span<const std::int64_t> counts, int per_unit,
                              std::uint32_t particles);

}  // namespace haff::analysis
