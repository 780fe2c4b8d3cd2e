// SPDX-License-Identifier: GPL-3.0-or-later

// The record of the requests of a campaign's processes to the disk: headers, each followed by
// `size` bytes of data.
#pragma once

#include <cstdint>

namespace haff::tests {

enum class Event : std::uint8_t { write, truncate, sync, make, remove, remove_and_sync };

enum class TracedFile : std::uint8_t { store, log, journal, none };

struct TraceHeader {
  Event event = Event::write;
  TracedFile file = TracedFile::none;
  std::uint16_t unused = 0;
  std::uint32_t size = 0;
  std::uint64_t offset = 0;  // of a write; the size to truncate to
};

}  // namespace haff::tests
