// SPDX-License-Identifier: GPL-3.0-or-later

// A particle's next event: it touches its partner or leaves its cell, whichever comes first.
#pragma once

#include <cstdint>

#include "engine/search/bricks.hpp"

namespace haff::engine {

struct Event {
  double time;                    // of the earlier of the two
  double contact_time;            // no contact is known before this time
  std::uint32_t partner;          // at contact_time
  std::uint32_t partner_changes;  // the partner's `changes` when this was computed
  Cell cell;
  std::uint8_t face;       // to leave through, or `contact`
  std::uint8_t owner = 0;  // the thread in whose queue the event is

  static constexpr Face contact = 6;
};
static_assert(sizeof(Event) == 32);

}  // namespace haff::engine
