// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/base/text/command_text.hpp"

#include <algorithm>

namespace haff::campaign {
namespace {

bool is_plain(char c) {
  constexpr std::string_view plain = "_-./:,@%+=";
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         plain.find(c) != std::string_view::npos;
}

}  // namespace

std::string quoted_word(std::string_view word) {
  if (!word.empty() && std::ranges::all_of(word, is_plain)) return std::string(word);
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + '\'';
}

std::string shell_word(std::string_view file) {
  return quoted_word(file.starts_with('-') ? "./" + std::string(file) : std::string(file));
}

std::string command_text(const std::string& command, const std::filesystem::path& store) {
  if (store == default_store) return "campaign " + command;
  return "campaign " + command + " --store " + shell_word(store.string());
}

}  // namespace haff::campaign
