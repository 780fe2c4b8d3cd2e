// SPDX-License-Identifier: GPL-3.0-or-later

// A store with a job that is being run.
#pragma once

#include <utility>

#include "schema/fixture.hpp"

namespace haff::schema {

// A store whose equilibrations are done, with one cooling job claimed.
struct Working {
  Store store;
  Claim claim;

  explicit Working(Store made = Store::in_memory(), double tau_max = 90)
      : store(std::move(made)), claim(start(store, tau_max)) {}

  static Claim start(Store& store, double tau_max) {
    store.add(plan({cooling()}, tau_max));
    equilibrate(store);
    return *store.claim(me, "test");
  }

  JobRow row() const { return store.job(claim.lease.job_id); }
};

inline Sample sample_at(double tau, double temperature = 0.5) {
  return {.tau = tau, .time = 2 * tau, .temperature = temperature};
}

}  // namespace haff::schema
