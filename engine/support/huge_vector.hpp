// SPDX-License-Identifier: GPL-3.0-or-later

// Vectors on huge pages. The engine accesses hundreds of megabytes at random: with pages of 4 KiB
// nearly every access would miss the TLB as well as the cache.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace haff::engine {

template <class T>
struct HugeAllocator {
  using value_type = T;
  static constexpr std::size_t huge_page = std::size_t{2} << 20;
  static constexpr std::size_t line = 64;

  HugeAllocator() = default;
  template <class U>
  explicit(false) HugeAllocator(const HugeAllocator<U>&) {}

  T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    void* const memory = bytes < huge_page ? std::aligned_alloc(line, rounded_up(bytes, line))
                                           : map_huge(rounded_up(bytes, huge_page));
    if (memory == nullptr) throw std::bad_alloc();
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    if (bytes < huge_page)
      std::free(memory);
    else
      munmap(memory, rounded_up(bytes, huge_page));
  }

  bool operator==(const HugeAllocator&) const { return true; }

 private:
  static std::size_t rounded_up(std::size_t bytes, std::size_t unit) {
    return (bytes + unit - 1) / unit * unit;
  }

  // Maps memory directly from the kernel: memory from malloc may have been in use before and then
  // keeps its small pages, whatever madvise says (as six sevenths of a gas of 500 000 particles
  // did).
  static void* map_huge(std::size_t bytes) {
    const std::size_t room = bytes + huge_page;
    void* const start =
        mmap(nullptr, room, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (start == MAP_FAILED) return nullptr;
    // Keeps an aligned piece and gives the rest back.
    const std::size_t before = (huge_page - reinterpret_cast<std::uintptr_t>(start)) % huge_page;
    char* const memory = static_cast<char*>(start) + before;
    if (before > 0) munmap(start, before);
    if (before < huge_page) munmap(memory + bytes, huge_page - before);
    madvise(memory, bytes, MADV_HUGEPAGE);
    return memory;
  }
};

template <class T>
using HugeVector = std::vector<T, HugeAllocator<T>>;

// Room for numbers that are written before they are read. It is not filled with zeros, which would
// take as long as a pass over it.
template <class T>
class HugeRoom {
 public:
  static_assert(std::is_trivially_copyable_v<T>);

  explicit HugeRoom(std::size_t size) : data_(HugeAllocator<T>().allocate(size)), size_(size) {}
  ~HugeRoom() { HugeAllocator<T>().deallocate(data_, size_); }
  HugeRoom(const HugeRoom&) = delete;
  HugeRoom& operator=(const HugeRoom&) = delete;

  std::size_t size() const { return size_; }
  T& operator[](std::size_t k) { return data_[k]; }
  void swap(HugeRoom& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
  }

 private:
  T* data_;
  std::size_t size_;
};

}  // namespace haff::engine
