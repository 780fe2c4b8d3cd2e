// SPDX-License-Identifier: GPL-3.0-or-later

// An input of the fuzzer, interpreted as edits of a sound store. Coverage finds the effect of each
// byte, so that few bytes can do much. apply() in edits.cpp has the kinds of edits and the bytes
// that each takes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace haff::tests {

// Bytes, one after another; zeros when they are used up.
class Input {
 public:
  Input(const std::uint8_t* bytes, std::size_t size) : at_(bytes), end_(bytes + size) {}

  bool is_used_up() const { return at_ == end_; }
  std::uint8_t byte() { return at_ == end_ ? 0 : *at_++; }
  std::uint64_t number(int bytes) {
    std::uint64_t value = 0;
    for (int k = 0; k < bytes; ++k) value = value << 8U | byte();
    return value;
  }
  std::string text(std::size_t most) {
    std::string made;
    while (made.size() < most && !is_used_up()) made += static_cast<char>(byte());
    return made;
  }

 private:
  const std::uint8_t* at_;
  const std::uint8_t* end_;
};

// A store with jobs of several gases in all states, with rows in every table, in a file of its own.
// Returns its bytes.
std::string sound_store(const std::filesystem::path& folder);

// Writes the store, edited, to a file.
void write_edited(const std::string& store, Input input, const std::filesystem::path& file);

}  // namespace haff::tests
