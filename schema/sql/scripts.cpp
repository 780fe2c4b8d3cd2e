// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/sql/scripts.hpp"

#include <string>

#include "schema/embedded.hpp"
#include "schema/sql/mean_views.hpp"

namespace haff::schema {

std::vector<std::string_view> scripts() {
  std::vector<std::string_view> texts;
  for (const Embedded& file : embedded())
    if (file.name.ends_with(".sql")) texts.push_back(file.text);
  static const std::string last_and_views = std::string(texts.back()) + mean_views_script();
  texts.back() = last_and_views;
  return texts;
}

int version_with(std::string_view script) {
  int version = 0;
  for (const Embedded& file : embedded()) {
    if (file.name.ends_with(".sql")) ++version;
    if (file.name == script) break;
  }
  return version;
}

}  // namespace haff::schema
