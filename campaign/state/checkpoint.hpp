// SPDX-License-Identifier: GPL-3.0-or-later

// A checkpoint: the state of a gas as bytes, and back.
//
// Layout, little-endian:
//   8 bytes  "HAFFGAS\n"
//   u32      version
//   u32      number of fields
//   fields   u8 length and name, u8 size of one element, u64 number of elements, elements
//   u64      checksum of everything before
// Fields are found by name, so a reader can say which one is missing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "engine/state.hpp"

namespace haff::campaign {

struct DamagedCheckpoint : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A sound checkpoint that a newer program wrote: it is not damaged, and not to be thrown away.
struct NewerCheckpoint : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The checksum at the end of a checkpoint with these bytes before it.
std::uint64_t checkpoint_checksum(std::span<const std::byte> bytes);

std::vector<std::byte> encode(const engine::State& state);

// Throws DamagedCheckpoint unless every bit is as encode() wrote it, NewerCheckpoint if a newer
// program's did.
engine::State decode(std::span<const std::byte> bytes);

// The engine::physics_version that computed this state. Throws as decode() does.
int physics_version_of(std::span<const std::byte> bytes);

}  // namespace haff::campaign
