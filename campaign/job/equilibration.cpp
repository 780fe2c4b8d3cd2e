// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/job/equilibration.hpp"

#include <fmt/format.h>

#include "analysis/observables/equilibrium.hpp"
#include "campaign/job/measurement.hpp"
#include "campaign/job/timetable.hpp"
#include "campaign/state/model.hpp"
#include "engine/initial.hpp"

namespace haff::campaign {
namespace {

static_assert(schema::equilibration_sample_every == engine::synchronization_period,
              "an equilibration is looked at where it can be stored");

NotEquilibrated not_equilibrated(const schema::Sample& sample, const schema::Job& job) {
  const auto mean = [&](int l) { return analysis::equilibrium_laguerre(l, job.particles, job.d); };
  return NotEquilibrated(fmt::format(
      "not in equilibrium after {} collisions per particle: a2 = {:.3g}, a3 = {:.3g}, a4 = {:.3g}, "
      "more than 4 standard errors from {:.3g}, {:.3g}, {:.3g}; plan it with a larger "
      "\"equilibrate\" than {}",
      sample.tau, sample.a2.value_or(0), sample.a3.value_or(0), sample.a4.value_or(0), mean(2),
      mean(3), mean(4), job.equilibrate));
}

}  // namespace

Ending equilibrate(Attempt& attempt) {
  const schema::Job& job = attempt.job();
  if (job.start.kind == schema::Start::Kind::file) throw StateWasGiven();
  const std::int64_t enough = synchronization_at_or_after(job.equilibrate);
  const std::int64_t too_long =
      synchronization_at_or_after(longest_equilibration * job.equilibrate);
  const auto stored = attempt.stored_state();
  attempt.begin(
      stored ? *stored
             : engine::initial_state(job.n, job.particles, job.seed, job.d, model_of(job).effects));

  // As many samples as synchronizations lie behind, tau = 0 among them.
  for (auto k = static_cast<std::int64_t>(attempt.samples().size());; ++k) {
    const double tau = synchronization_tau(k);
    if (!attempt.advance_to(engine::collisions_at(tau, job.particles))) return attempt.leave();
    attempt.sample(tau);
    if (!job.start.is_equilibrated()) return attempt.finish(tau, std::nullopt);
    const schema::Sample& now = attempt.samples().back();
    if (k >= enough && is_equilibrated(now, job)) return attempt.finish(tau, std::nullopt);
    if (k >= too_long) throw not_equilibrated(now, job);

    const bool leaving = attempt.is_asked_to_leave();
    if (k > 0 && (leaving || is_checkpoint(k, attempt.claim().checkpoint_every)))
      attempt.commit(tau);
    if (leaving) return attempt.leave();
  }
}

}  // namespace haff::campaign
