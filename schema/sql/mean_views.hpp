// SPDX-License-Identifier: GPL-3.0-or-later

// The views that average over realizations: mean_series, mean_temperatures, mean_tau_c and
// mean_profiles. They hold no data. The program makes them out of its list of columns whenever a
// store is made or brought forward. Private to schema/.
#pragma once

#include <string>

namespace haff::schema {

// SQL that makes them in place of those of an older program.
std::string mean_views_script();

}  // namespace haff::schema
