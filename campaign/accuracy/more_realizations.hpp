// The seeds that bring targets nearer.
#pragma once

#include <optional>

#include "schema/store/store.hpp"

namespace haff::campaign {

// Plans what the targets need next, as far as `affordable` CPU seconds go. Returns how many cooling
// jobs were added.
int add_realizations(schema::Store& store, std::optional<double> affordable);

}  // namespace haff::campaign
