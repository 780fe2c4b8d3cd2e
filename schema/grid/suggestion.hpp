// SPDX-License-Identifier: GPL-3.0-or-later

// Words that were typed wrongly.
#pragma once

#include <string>
#include <vector>

namespace haff::schema {

// Letters to insert, delete or replace to make one word the other, whatever their case
// (Levenshtein's distance).
std::size_t distance(const std::string& one, const std::string& other);

// What to say of an unknown word: the word that was meant, if less than half of it is
// wrong ("did you mean "a2"?"), else all of them ("expected one of "a2", "a3""). There must be one.
std::string suggestion(const std::string& word, const std::vector<std::string>& known);

}  // namespace haff::schema
