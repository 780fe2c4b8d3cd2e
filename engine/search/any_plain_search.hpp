// SPDX-License-Identifier: GPL-3.0-or-later

// The plain search for any box, spheres or disks, chosen at run time: where speed does not matter,
// one compilation of an event loop serves them all.
#pragma once

#include <memory>
#include <utility>

#include "engine/search/plain_search.hpp"

namespace haff::engine {

template <class PairGeometry>
class AnyPlainSearch {
 public:
  // The size of the box decides which images are candidates.
  AnyPlainSearch(const Gas& gas, const PairGeometry& geometry);

  Contact around(std::uint32_t p, Cell cell, double now) const {
    return search_->around(p, cell, now);
  }
  Contact around_higher(std::uint32_t p, Cell cell) const {
    return search_->around_higher(p, cell);
  }
  std::pair<Contact, Contact> around_both(std::uint32_t p, Cell p_cell, std::uint32_t q,
                                          Cell q_cell) const {
    return search_->around_both(p, p_cell, q, q_cell);
  }
  Contact beyond(std::uint32_t p, Cell cell, Face face, double now) const {
    return search_->beyond(p, cell, face, now);
  }
  Exit exit(std::uint32_t p, Cell cell, double now) const { return search_->exit(p, cell, now); }

 private:
  struct Interface {
    Interface() = default;
    virtual ~Interface() = default;
    Interface(const Interface&) = delete;
    Interface& operator=(const Interface&) = delete;
    virtual Contact around(std::uint32_t p, Cell cell, double now) const = 0;
    virtual Contact around_higher(std::uint32_t p, Cell cell) const = 0;
    virtual std::pair<Contact, Contact> around_both(std::uint32_t p, Cell p_cell, std::uint32_t q,
                                                    Cell q_cell) const = 0;
    virtual Contact beyond(std::uint32_t p, Cell cell, Face face, double now) const = 0;
    virtual Exit exit(std::uint32_t p, Cell cell, double now) const = 0;
  };
  template <class Search>
  struct Holder;
  template <int d>
  static std::unique_ptr<Interface> chosen(const Gas& gas, const PairGeometry& geometry);

  std::unique_ptr<Interface> search_;
};

}  // namespace haff::engine
