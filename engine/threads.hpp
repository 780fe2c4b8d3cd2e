// SPDX-License-Identifier: GPL-3.0-or-later

// How many threads are worthwhile for a gas, and how much faster they are.
#pragma once

#include <cstdint>

namespace haff::engine {

// The largest number of threads with which a gas of this size was measured to be faster than with
// fewer. With this number, every thread has some 50 000 particles and a slab of twelve bricks or
// more; below that, windows often have to be repaired (decisions/several-cores.md). 1 for a small
// gas.
unsigned useful_threads(std::uint32_t particles, double n, int d = 3);

// How many times as fast such a gas is on this many threads as on one: measured for two threads,
// and estimated from counts of events for more (decisions/several-cores.md).
double expected_speed_up(unsigned threads, std::uint32_t particles, double n, int d = 3);

}  // namespace haff::engine
