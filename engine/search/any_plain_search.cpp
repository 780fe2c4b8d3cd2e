// SPDX-License-Identifier: GPL-3.0-or-later

#include "engine/search/any_plain_search.hpp"

#include "engine/collision/two_species.hpp"

namespace haff::engine {

template <class PairGeometry>
template <class Search>
struct AnyPlainSearch<PairGeometry>::Holder final : Interface {
  Holder(const Gas& gas, const PairGeometry& geometry) : search(gas, geometry) {}

  Contact around(std::uint32_t p, Cell cell, double now) const override {
    return search.around(p, cell, now);
  }
  Contact around_higher(std::uint32_t p, Cell cell) const override {
    return search.around_higher(p, cell);
  }
  std::pair<Contact, Contact> around_both(std::uint32_t p, Cell p_cell, std::uint32_t q,
                                          Cell q_cell) const override {
    return search.around_both(p, p_cell, q, q_cell);
  }
  Contact beyond(std::uint32_t p, Cell cell, Face face, double now) const override {
    return search.beyond(p, cell, face, now);
  }
  Exit exit(std::uint32_t p, Cell cell, double now) const override {
    return search.exit(p, cell, now);
  }

  Search search;
};

template <class PairGeometry>
template <int d>
auto AnyPlainSearch<PairGeometry>::chosen(const Gas& gas, const PairGeometry& geometry)
    -> std::unique_ptr<Interface> {
  if (!Bricks::fits(gas.box))
    return std::make_unique<Holder<PlainSearch<PairGeometry, AllParticlesAllImages, d>>>(gas,
                                                                                         geometry);
  if (!gas.bricks.tell_images_apart())
    return std::make_unique<Holder<PlainSearch<PairGeometry, NearbyAllImages, d>>>(gas, geometry);
  return std::make_unique<Holder<PlainSearch<PairGeometry, NearbyNearestImage, d>>>(gas, geometry);
}

template <class PairGeometry>
AnyPlainSearch<PairGeometry>::AnyPlainSearch(const Gas& gas, const PairGeometry& geometry)
    : search_(gas.box.d == 2 ? chosen<2>(gas, geometry) : chosen<3>(gas, geometry)) {}

template class AnyPlainSearch<HardSpheres>;
template class AnyPlainSearch<TwoSpecies>;

}  // namespace haff::engine
