// SPDX-License-Identifier: GPL-3.0-or-later

// The checksum of a checkpoint: FNV-1a with 64 bits (Fowler, Noll and Vo). Every step is
// invertible, so that any change confined to one byte, and any bit flip, changes the sum; other
// damage goes unseen with probability 2^-64. It is short, so that users can write it again for a
// program of their own that reads the store.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace haff::schema {

inline std::uint64_t checksum(std::span<const std::byte> bytes) {
  std::uint64_t sum = 0xcbf29ce484222325;
  for (const std::byte byte : bytes) {
    sum ^= std::to_integer<std::uint64_t>(byte);
    sum *= 0x100000001b3;
  }
  return sum;
}

}  // namespace haff::schema
