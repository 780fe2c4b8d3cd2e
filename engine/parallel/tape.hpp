// SPDX-License-Identifier: GPL-3.0-or-later

// A list that is emptied and filled again and again. Adding an item takes a store and a comparison;
// with std::vector it is a call, which takes 2 % of the time of a window.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace haff::engine {

template <class T>
class Tape {
 public:
  // Makes room for this many more items, to be written at once.
  [[gnu::always_inline]] T* add(std::size_t items) {
    if (count_ + items > room_.size()) [[unlikely]]
      grow(items);
    T* const place = room_.data() + count_;
    count_ += items;
    __builtin_prefetch(place + ahead, 1, 3);  // otherwise stores would wait for the cache
    return place;
  }
  void clear() { count_ = 0; }
  void resize(std::size_t count) {
    if (count > room_.size()) room_.resize(count);
    count_ = count;
  }
  void swap(Tape& other) {
    room_.swap(other.room_);
    std::swap(count_, other.count_);
  }

  std::size_t size() const { return count_; }
  T* begin() { return room_.data(); }
  const T* begin() const { return room_.data(); }
  const T* end() const { return room_.data() + count_; }
  std::size_t memory() const { return room_.capacity() * sizeof(T); }

 private:
  static constexpr std::size_t ahead = 512 / sizeof(T);

  [[gnu::noinline]] void grow(std::size_t items) { room_.resize(2 * count_ + items + 64); }

  std::vector<T> room_;
  std::size_t count_ = 0;
};

}  // namespace haff::engine
