// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/job/cooling.hpp"

#include "campaign/job/measurement.hpp"
#include "campaign/job/timetable.hpp"
#include "campaign/state/first_state.hpp"

namespace haff::campaign {

Ending cool(Attempt& attempt) {
  Timetable timetable(attempt.job(), attempt.claim().tau_max, attempt.claim().checkpoint_every);
  if (const auto state = attempt.stored_state()) {
    timetable.skip_through(state->collisions);
    attempt.begin(*state);
  } else {
    attempt.begin(first_state(attempt.state_of_equilibration(), attempt.job().start));
  }

  while (const auto stop = timetable.next()) {
    if (!attempt.advance_to(stop->collisions)) return attempt.leave();
    if (stop->due == Stop::Due::sample) {
      attempt.sample(stop->tau);
      continue;
    }
    if (stop->due == Stop::Due::snapshot) {
      attempt.snapshot(stop->tau);
      continue;
    }
    const bool leaving = attempt.is_asked_to_leave();
    if (stop->keep || leaving) attempt.commit(stop->tau);
    if (leaving) return attempt.leave();
  }
  return attempt.finish(std::nullopt, results(attempt.samples(), attempt.job()));
}

}  // namespace haff::campaign
