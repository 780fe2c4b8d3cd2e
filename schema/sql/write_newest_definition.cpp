// SPDX-License-Identifier: GPL-3.0-or-later

// Runs when the program is built, and prints a C++ source that holds the definition of the newest
// store. Each command compares the store that it opens with this text; without it, each would have
// to run all scripts first, which takes longer than the rest of most commands.
#include <exception>
#include <iostream>

#include "schema/sql/definition.hpp"
#include "schema/sql/scripts.hpp"

int main() try {
  using namespace haff::schema;
  std::cout << "// Made by schema/sql/write_newest_definition.cpp.\n"
               "#include \"schema/sql/definition.hpp\"\n\n"
               "namespace haff::schema {\n\n"
               "std::string_view newest_definition() {\n"
               "  return R\"newest("
            << in_one_text(definition_made_by(scripts()))
            << ")newest\";\n}\n\n}  // namespace haff::schema\n";
  return std::cout.flush() ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << "The scripts in schema/sql fail: " << error.what() << '\n';
  return 1;
}
