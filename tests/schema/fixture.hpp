// SPDX-License-Identifier: GPL-3.0-or-later

// A small campaign, shared by the tests of this folder.
#pragma once

#include <string>
#include <vector>

#include "schema/store/store.hpp"
#include "support/temporary_folder.hpp"

namespace haff::schema {

using haff::TemporaryFolder;

inline Job cooling(double e = 0.8, std::uint64_t seed = 1) {
  return {.kind = Kind::cooling,
          .e = e,
          .n = 0.4,
          .particles = 1000,
          .seed = seed,
          .observables = {"temperature", "laguerre"}};
}

// Cooling jobs with the equilibrations that they need.
inline std::vector<Planned> plan(const std::vector<Job>& jobs, double tau_max = 90) {
  std::vector<Planned> all;
  for (const Job& job : jobs) {
    const Job start = equilibration_of(job);
    bool known = false;
    for (const Planned& planned : all) known = known || planned.job == start;
    if (!known) all.push_back({.job = start, .tau_max = tau_max_of_equilibration(start)});
    all.push_back({.job = job, .tau_max = tau_max});
  }
  return all;
}

inline const Owner me{.host = "here", .boot_id = "this boot", .pid = 1, .started = 10};
inline const Owner another{.host = "here", .boot_id = "this boot", .pid = 2, .started = 20};

inline std::vector<std::byte> bytes(std::size_t size, unsigned start = 0) {
  std::vector<std::byte> made(size);
  for (std::size_t i = 0; i < size; ++i) made[i] = std::byte((start + 31 * i + i / 251) & 0xff);
  return made;
}

// Runs a claimed job to its end at once.
inline Status complete(Store& store, const Claim& claim, const std::vector<Sample>& samples = {},
                       const std::optional<Results>& results = std::nullopt) {
  const Commit commit{.samples = samples,
                      .checkpoint = Checkpoint{.tau = claim.tau_max, .state = bytes(8)},
                      .progress = {.tau = claim.tau_max}};
  return store.finish(claim.lease, commit, results, claim.tau_max);
}

// Runs every equilibration of a store.
inline void equilibrate(Store& store) {
  while (store.summary().waiting > 0) complete(store, *store.claim(me, "test"));
}

// The error that `work` throws, and its message.
template <class Work>
StoreError error_of(Work work) {
  try {
    work();
  } catch (const StoreError& error) {
    return error;
  }
  return StoreError("not refused");
}

template <class Work>
std::string refusal(Work work) {
  return error_of(work).what();
}

}  // namespace haff::schema
