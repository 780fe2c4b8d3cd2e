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
    std::string name, variable, meaning;
    std::vector<schema::Value> taus;  // at which it was taken
  };
  struct Parameter {
    std::string name;
    std::vector<schema::Value> values;
  };
  std::vector<Described> columns;     // that some finished run has
  std::vector<Profile> profiles;      // likewise
  std::vector<Described> quantities;  // of accuracy/quantity.hpp
  std::vector<Parameter> parameters;  // with the values of finished runs
};

Inventory inventory_of(const schema::Reader& store);

// "0.05, 0.4", of many the first and the last ones.
std::string listed(const std::vector<schema::Value>& values);

}  // namespace haff::campaign
