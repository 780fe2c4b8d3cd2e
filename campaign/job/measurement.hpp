// One row of samples: what a gas shows now, and what it did since the row before.
#pragma once

#include <optional>
#include <vector>

#include "engine/simulation.hpp"
#include "schema/store.hpp"

namespace haff::campaign {

// Takes the sample of a job at tau, and the engine's tally with it. `previous` is the row before,
// nothing at the start. Rates are averages over the interval between the two rows; pressure is
// n (T_before + T_now) / 2 + virial / (d V dt), the kinetic part by the trapezoidal rule. What
// does not exist (a rate at the start, a coefficient of a gas at rest) stays empty.
schema::Sample measure(engine::Simulation& gas, const schema::Job& job, double tau,
                       const std::optional<schema::Sample>& previous);

// What the whole gas shows now, beside a sample.
struct Views {
  std::vector<schema::Profile> profiles;
  std::vector<schema::Field> fields;
};

// The profiles and fields that the job takes with this sample, none at most tau. Fills those
// columns of the sample that are taken with profiles.
Views view(const engine::Simulation& gas, const schema::Job& job, schema::Sample& sample);

// The end of the homogeneous stage, from all samples of a job.
schema::Results results(const std::vector<schema::Sample>& samples, const schema::Job& job);

// Whether a_2, a_3 and a_4 are those of elastic equilibrium: within 4 standard errors of their
// mean for so few particles at given energy and momentum.
bool is_equilibrated(const schema::Sample& sample, const schema::Job& job);

// Mean a_l of N particles at equilibrium with fixed energy and zero total momentum. The velocities
// are then uniform on a sphere in D = d(N-1) dimensions, where the moments fall short of their
// Gaussian values, <c^2k> = Gaussian / prod_{j<k} (1 + 2j/D): for a_2 by 2/(D+2).
double equilibrium_laguerre(int l, const schema::Job& job);

}  // namespace haff::campaign
