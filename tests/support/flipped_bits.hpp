// SPDX-License-Identifier: GPL-3.0-or-later

// Single flipped bits in the file of a store that holds every effect and observable: each one that
// changes what the store says is found, and each one in a value is put right.
#pragma once

#include <cstdint>

namespace haff::tests {

struct FlippedBits {
  int flips = 0;
  int telling = 0;  // those that change what the store says, or make it unreadable
  int found = 0;    // of these, by `campaign verify`, or by a run that stops there
  int mended = 0;   // of these, by `verify --repair`, `retry` and `run`: flips of values alone
};

// values: of samples, profiles, fields, results, states, jobs. anywhere: also in SQLite's own
// bytes, and in many that mean nothing.
enum class BitsOf { values, anywhere };

// half_run: jobs are pending, and go on from the states of a shorter tau_max.
enum class Store { finished, half_run };

// Flips this many bits, each in a fresh copy of the store, at places that the seed decides. If a
// flip is not found, or not put right, the test that calls fails and names the place.
FlippedBits flip_bits(std::uint64_t seed, int flips, BitsOf of, Store store = Store::finished);

}  // namespace haff::tests
