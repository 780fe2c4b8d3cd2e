// SPDX-License-Identifier: GPL-3.0-or-later

// Numbers as text, for tables, captions and messages; and back.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace haff::campaign {

// The shortest text that reads back as the same number.
std::string number_text(double value);

// The number that is all of this text; nothing for anything else, or for what is not finite.
std::optional<double> number_in(std::string_view text);

// A value with the digits that its error permits, including two uncertain ones: 57.49. Five digits
// where the error is not known.
std::string value_text(double value, double error);

// The same with the error: 57.49 ± 1.14.
std::string value_with_error(double value, double error);

// Digits in groups of three: 32 000.
std::string count_text(long long count);

// Three digits and a unit: 1.5 GB.
std::string bytes_text(double bytes);

// e with at least two decimals, as the paper writes it: 0.80, 0.865. [no unit]
std::string restitution_text(double e);

// n likewise. [sigma^-d]
std::string density_text(double n);

}  // namespace haff::campaign
