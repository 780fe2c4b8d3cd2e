// SPDX-License-Identifier: GPL-3.0-or-later

// Where a key of a grid stands in its file, and what it holds. Private to schema/.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "schema/grid/document.hpp"

namespace haff::schema {

// A value and where in the file it stands.
struct Placed {
  Pointer where;
  Json value;
};

// A scalar, or what a list holds, each with its place.
std::vector<Placed> items(const Placed& placed);

// The items of the member `key` of an effect.
std::vector<Placed> items(const Placed& effect, const std::string& key);

// The effect of this name wherever it stands among the effects of a grid, without a list around it.
std::vector<Placed> asked(const Placed& effects, const std::string& effect);

// A value that holds lists, at any depth, becomes several values without lists: the product of all
// lists. Numbers are written in one way, so that equal effects have equal texts.
std::vector<Json> expanded(const Json& value);

// How many these are, without making them.
double count_expanded(const Json& value);

// A grid of the document: its own keys, else those beside "grids", else the schema's defaults.
class Source {
 public:
  Source(const Json& document, Pointer where) : document_(document), where_(std::move(where)) {}

  const Pointer& where() const { return where_; }

  std::optional<Placed> find(const std::string& key) const;
  Placed operator[](const std::string& key) const { return find(key).value(); }
  bool is_given(const std::string& key) const;  // not by default alone

  template <class Number>
  std::vector<Number> list(const std::string& key) const {
    std::vector<Number> numbers;
    for (const Placed& item : items((*this)[key]))
      numbers.push_back(static_cast<Number>(item.value.get<double>() + 0.0));  // -0 is 0
    return numbers;
  }

  std::vector<double> e() const { return find("e") ? list<double>("e") : std::vector<double>(); }
  std::vector<std::string> observables() const;  // sorted

 private:
  const Json& document_;
  Pointer where_;
};

// The grids of a document: itself, or those that it lists.
std::vector<Source> sources(const Json& document);

// The shortest text that reads back as the same number: 0.8, 32000.
std::string text(double value);

// The number to three digits: 0.785, 2e+08.
std::string rounded(double value);

}  // namespace haff::schema
