// SPDX-License-Identifier: GPL-3.0-or-later

// Jobs in words, for tables, logs and messages.
#pragma once

#include <string>

#include "schema/grid/job.hpp"

namespace haff::campaign {

// "cooling e=0.8 n=0.4 N=32000 seed 1"; an equilibration has no e.
std::string describe(const schema::Job& job);

// Its e; a dash where its law of restitution has none.
std::string e_text(const schema::Job& job);

}  // namespace haff::campaign
