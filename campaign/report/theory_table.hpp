// SPDX-License-Identifier: GPL-3.0-or-later

// The theory that is drawn beside the curves of the page: a table, since the browser cannot compute
// it.
#pragma once

#include "schema/store/averaged_tables.hpp"

namespace haff::campaign {

// For every gas in the mean views, the lines that curves/theory_lines has for its columns and
// profiles, except direct simulations that would have to be computed. Columns: those by which
// mean_profiles tells gases apart, then
//   name     of the column or profile
//   tau      of a profile; NULL for a column, which is drawn against tau
//   line     which theory, as a legend says it
//   x, time  tau or the profile's variable; the time of tau, where a theory has it
//   value
schema::ComputedTable theory_table(const schema::Reader& store);

}  // namespace haff::campaign
