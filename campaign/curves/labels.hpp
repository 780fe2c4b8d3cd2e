// SPDX-License-Identifier: GPL-3.0-or-later

// How columns, profiles, quantities and parameters are written on axes and in legends: gnuplot's
// enhanced text.
#pragma once

#include <string>
#include <string_view>

namespace haff::campaign {

// The usual symbol, "{/:Italic a}_2" for a2. A name or expression without a symbol stays as it is,
// and none of it is read as markup.
std::string symbol(std::string_view name);

// The symbol with the unit.
std::string axis_label(std::string_view name);

// Text that may come from a store or a user, as enhanced text that shows it unchanged.
std::string literal(std::string_view text);

}  // namespace haff::campaign
