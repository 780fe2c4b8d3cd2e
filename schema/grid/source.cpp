// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/grid/source.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include "schema/grid/rules.hpp"

namespace haff::schema {

std::vector<Placed> items(const Placed& placed) {
  if (!placed.value.is_array()) return {placed};
  std::vector<Placed> list;
  list.reserve(placed.value.size());
  for (std::size_t i = 0; i < placed.value.size(); ++i)
    list.push_back({placed.where / i, placed.value[i]});
  return list;
}

std::vector<Placed> items(const Placed& effect, const std::string& key) {
  return items({effect.where / key, effect.value[key]});
}

std::vector<Placed> asked(const Placed& effects, const std::string& effect) {
  std::vector<Placed> list;
  for (const Placed& one : items(effects))
    if (one.value.contains(effect))
      for (Placed& choice : items(one, effect)) list.push_back(std::move(choice));
  return list;
}

std::vector<Json> expanded(const Json& value) {
  if (value.is_number()) return {value.get<double>() + 0.0};
  std::vector<Json> all;
  if (value.is_array()) {
    for (const Json& item : value)
      for (Json& one : expanded(item)) all.push_back(std::move(one));
    return all;
  }
  if (!value.is_object()) return {value};
  all.push_back(Json::object());
  for (const auto& [key, member] : value.items()) {
    std::vector<Json> product;
    for (const Json& choice : expanded(member))
      for (Json one : all) {
        one[key] = choice;
        product.push_back(std::move(one));
      }
    all = std::move(product);
  }
  return all;
}

double count_expanded(const Json& value) {
  double count = value.is_array() ? 0 : 1;
  if (value.is_array())
    for (const Json& item : value) count += count_expanded(item);
  if (value.is_object())
    for (const auto& [key, member] : value.items()) count *= count_expanded(member);
  return count;
}

std::optional<Placed> Source::find(const std::string& key) const {
  for (const Pointer& place : {where_ / key, Pointer() / key})
    if (document_.contains(place)) return Placed{place, document_.at(place)};
  if (Json value = default_value(key); !value.is_null()) return Placed{where_ / key, value};
  return std::nullopt;
}

bool Source::is_given(const std::string& key) const {
  return document_.contains(where_ / key) || document_.contains(Pointer() / key);
}

std::vector<std::string> Source::observables() const {
  std::vector<std::string> names;
  for (const Placed& item : items((*this)["observables"]))
    names.push_back(item.value.get<std::string>());
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<Source> sources(const Json& document) {
  if (!document.contains("grids")) return {Source(document, Pointer())};
  std::vector<Source> list;
  for (std::size_t i = 0; i < document["grids"].size(); ++i)
    list.emplace_back(document, Pointer() / "grids" / i);
  return list;
}

std::string text(double value) {
  std::array<char, 32> digits;
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
}

std::string rounded(double value) {
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                 std::chars_format::general, 3);
  return {digits.data(), end.ptr};
}

}  // namespace haff::schema
