// SPDX-License-Identifier: GPL-3.0-or-later

// The seeds that bring targets nearer.
#pragma once

#include <optional>
#include <vector>

#include "schema/store/store.hpp"

namespace haff::campaign {

// Plans what these targets of the store need next, as far as `affordable` CPU seconds go. Returns
// how many cooling jobs were added.
int add_realizations(schema::Store& store, const std::vector<schema::Target>& targets,
                     std::optional<double> affordable);

}  // namespace haff::campaign
