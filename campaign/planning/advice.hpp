// SPDX-License-Identifier: GPL-3.0-or-later

// What a user should know of a plan beside its price: jobs that differ from those of the store by
// rounding, or that will compute again what the store has.
#pragma once

#include <string>
#include <vector>

#include "schema/store/store.hpp"

namespace haff::campaign {

// Lines such as "e = 0.8500000001 of this grid and 0.85 of the store differ by less than 1e-9:
// ...", one for each pair of values. `known`: the jobs of the store.
std::vector<std::string> near_twins(const std::vector<schema::Planned>& plan,
                                    const std::vector<schema::JobRow>& known);

// How many new cooling jobs of the plan differ only in their observables from a job of the store
// that has run. Observables are part of a job, so that such a gas is computed a second time.
std::size_t recomputed(const std::vector<schema::Planned>& plan,
                       const std::vector<schema::JobRow>& known);

}  // namespace haff::campaign
