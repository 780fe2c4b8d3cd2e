// SPDX-License-Identifier: GPL-3.0-or-later

// The names in an SQL expression that a user has typed.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace haff::schema {

// Words, with the dots in them (roughness.beta), that are no functions and stand outside of quotes.
// Keywords such as AND are among them.
std::vector<std::string> names_in(std::string_view sql);

// The expression with each name replaced by what `replacement` makes of it.
std::string with_names(std::string_view sql,
                       const std::function<std::string(std::string_view)>& replacement);

}  // namespace haff::schema
