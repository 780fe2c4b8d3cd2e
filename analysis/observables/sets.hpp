// SPDX-License-Identifier: GPL-3.0-or-later

// Sets that are merged step by step: the cells, or the particles, of one cluster. For the .cpp
// files of this room only.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace haff::analysis {

// Sets of numbers 0 ... count-1; the root of a set is its smallest member.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t root(std::size_t member) {
    while (parent_[member] != member) member = parent_[member] = parent_[parent_[member]];
    return member;
  }
  void join(std::size_t one, std::size_t other) {
    const auto [low, high] = std::minmax({root(one), root(other)});
    parent_[high] = low;
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace haff::analysis
