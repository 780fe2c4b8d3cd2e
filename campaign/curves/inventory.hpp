// SPDX-License-Identifier: GPL-3.0-or-later

// What a store has to be drawn: `campaign plot --list`.
#pragma once

#include <string>
#include <vector>

#include "schema/store/store.hpp"

namespace haff::campaign {

struct Inventory {
  struct Described {
    std::string name, meaning;
  };
  struct Profile {
    std::string name, variable, values;  // tau at which it was taken
    std::string meaning;
  };
  struct Parameter {
    std::string name, values;
  };
  std::vector<Described> columns;     // that some finished run has
  std::vector<Profile> profiles;      // likewise
  std::vector<Described> quantities;  // of accuracy/quantity.hpp
  std::vector<Parameter> parameters;  // with the values of finished runs
};

Inventory inventory_of(const schema::Reader& store);

}  // namespace haff::campaign
