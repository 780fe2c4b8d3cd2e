// SPDX-License-Identifier: GPL-3.0-or-later

// Whether a target is something that every run of a grid measures. Private to schema/.
#pragma once

#include <string>
#include <vector>

#include "schema/grid/source.hpp"

namespace haff::schema {

// Throws GridError where it is not, or where its pilot runs are too few to judge from.
void must_be_reachable(const std::string& file, const Source& source,
                       const std::vector<double>& tau_max);

}  // namespace haff::schema
