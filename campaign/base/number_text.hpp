// Numbers as text, for tables, captions and messages.
#pragma once

#include <string>

namespace haff::campaign {

// The shortest text that reads back as the same number.
std::string number_text(double value);

// Digits in groups of three: 32 000.
std::string count_text(long long count);

// Three digits and a unit: 1.5 GB.
std::string bytes_text(double bytes);

// e with at least two decimals, as the paper writes it: 0.80, 0.865. [no unit]
std::string restitution_text(double e);

// n likewise. [sigma^-d]
std::string density_text(double n);

}  // namespace haff::campaign
