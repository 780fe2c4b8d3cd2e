// SPDX-License-Identifier: GPL-3.0-or-later

// How columns, profiles, quantities and parameters are written on axes and in legends: gnuplot's
// enhanced text.
#pragma once

#include <string>
#include <string_view>

namespace haff::campaign {

// The symbol of the field's papers, "{/:Italic a}_2" for a2; a name or expression without one as it
// is, none of it read as markup.
std::string symbol(std::string_view name);

// The symbol with the unit.
std::string axis_label(std::string_view name);

// Text that may come from a store or a user, as enhanced text that shows just that.
std::string literal(std::string_view text);

}  // namespace haff::campaign
