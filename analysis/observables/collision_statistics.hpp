// SPDX-License-Identifier: GPL-3.0-or-later

// What collisions were like: densities of free times, of impact parameters and of normal speeds,
// from counts in bins of equal width that begin at zero. Theory: theory/collision_statistics.hpp.
//
// Of the collisions of an interval, each has two particles with a free time, one impact parameter
// and one normal speed. A bin with n of them has a relative standard error of 1/sqrt(n) by chance;
// that of a mean over realizations holds in any case.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace haff::analysis {

struct Density {
  std::vector<double> x;      // middle of each bin
  std::vector<double> value;  // mean over the bin: 1 in all if it is uniform on [0, 1]
};

// Of all bins. Both densities are empty if nothing was counted, and throw std::invalid_argument
// without a bin.
Density density(std::span<const std::int64_t> counts, double width);

// The same where the last bin is for all that is beyond the others: it is counted, and left out.
Density density_with_rest(std::span<const std::int64_t> counts, double width);

// Likewise, of free times 2k/N on the collision clock, k = 1, 2, ... collisions of a gas of N
// particles: bin i of `per_unit` bins in a unit holds the k with floor(per_unit 2k/N) = i. Where N
// is small, or no multiple of per_unit, bins do not have the same number of k; this is made up for.
Density density_of_free_times(std::span<const std::int64_t> counts, int per_unit,
                              std::uint32_t particles);

}  // namespace haff::analysis
