// SPDX-License-Identifier: GPL-3.0-or-later

// Displacements and velocities since waiting times, through the faces of the box and through a
// checkpoint.
#include "campaign/job/diffusion.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "analysis/theory/enskog.hpp"
#include "analysis/theory/self_diffusion.hpp"
#include "campaign/state/checkpoint.hpp"
#include "campaign/state/model.hpp"
#include "engine/initial.hpp"

using namespace haff;
using namespace haff::campaign;
using doctest::Approx;

namespace {

schema::Job job(double n, std::uint32_t particles, std::vector<std::string> observables) {
  schema::Job job;
  job.e = 1;
  job.n = n;
  job.particles = particles;
  job.seed = 1;
  job.observables = std::move(observables);
  return job;
}

// A gas that is followed in the same way as in an attempt.
struct Followed {
  Followed(const schema::Job& its_job, const engine::State& state, unsigned threads = 1)
      : job(its_job),
        gas(model_of(job), state, engine::SearchBackend::simd, {.count = threads}),
        diffusion(job) {
    diffusion.begin(gas, state);
  }

  void run_to(double tau) {
    const std::int64_t end = engine::collisions_at(tau, job.particles);
    while (gas.collisions() < end) {
      gas.run_to(std::min(end, diffusion.next_look()));
      if (gas.collisions() == diffusion.next_look()) diffusion.look(gas);
    }
  }
  std::vector<schema::Profile> sample_at(double tau) {
    run_to(tau);
    return diffusion.sample(gas, tau);
  }

  const schema::Job& job;
  engine::Simulation gas;
  Diffusion diffusion;
};

engine::State start_of(const schema::Job& job) {
  return engine::initial_state(job.n, job.particles, job.seed, job.d);
}

double value_of(const std::vector<schema::Profile>& points, const std::string& name, double tau) {
  for (const schema::Profile& each : points)
    if (each.name == name && each.tau == tau) return each.value.front();
  return std::nan("");
}

}  // namespace

TEST_CASE("diffusion: without msd and vacf the gas is not observed") {
  const auto plain = job(0.2, 108, {"temperature"});
  Followed followed(plain, start_of(plain));
  CHECK(followed.diffusion.next_look() > engine::collisions_at(1e9, plain.particles));
  CHECK(followed.sample_at(1).empty());
  engine::State state = start_of(plain);
  followed.diffusion.store(state);
  CHECK(state.memory.empty());
}

TEST_CASE("diffusion: free flight before collisions") {
  // By tau = 0.01, 20 of the 2000 particles have collided, and have lost at most 2/3 of part of
  // their displacement.
  auto dilute = job(0.01, 2000, {"msd", "vacf"});
  dilute.sample_every = 0.01;
  Followed followed(dilute, start_of(dilute));
  CHECK(value_of(followed.sample_at(0), "vacf", 0) == Approx(1).epsilon(1e-14));
  const auto points = followed.sample_at(0.01);
  const double t = followed.gas.time();
  CHECK(value_of(points, "msd", 0) == Approx(2 * t * t).epsilon(0.01));  // <v^2> = 2 E(0)
  CHECK(value_of(points, "vacf", 0) == Approx(1).epsilon(0.01));
}

TEST_CASE("diffusion: the number of observations changes no bit") {
  // This holds also where velocities change between collisions.
  for (const char* effects :
       {"{}", R"({"shuffle":{"every":1}})", R"({"thermostat":{"rate":0.05}})"}) {
    CAPTURE(effects);
    auto physics = job(0.02, 100, {"msd@2", "vacf@2"});
    physics.e = 0.9;
    physics.effects = effects;
    Followed seldom(physics, start_of(physics)), often(physics, start_of(physics));
    for (const double tau : {2.0, 5.0, 30.0}) {
      while (often.gas.collisions() < engine::collisions_at(tau, physics.particles)) {
        often.gas.run_to(often.gas.collisions() + 1);
        often.diffusion.look(often.gas);
      }
      CHECK(seldom.sample_at(tau) == often.diffusion.sample(often.gas, tau));
    }
  }
}

TEST_CASE("diffusion: any number of threads gives the same bits") {
  auto physics = job(0.4, 4000, {"msd", "vacf@2"});
  physics.e = 0.8;
  Followed one(physics, start_of(physics)), four(physics, start_of(physics), 4);
  one.sample_at(0);
  four.sample_at(0);
  for (const double tau : {2.0, 5.0, 12.0}) CHECK(one.sample_at(tau) == four.sample_at(tau));
  CHECK(four.gas.windows()->count > 0);
}

TEST_CASE("diffusion: a checkpoint carries images and waiting times to the last bit") {
  const auto physics = job(0.1, 500, {"msd", "msd@5", "vacf@5"});
  Followed whole(physics, start_of(physics));
  for (const double tau : {0.0, 5.0, 9.0}) whole.sample_at(tau);
  whole.run_to(10);
  engine::State stored = whole.gas.state();
  whole.diffusion.store(stored);
  Followed resumed(physics, decode(encode(stored)));
  for (const double tau : {11.0, 12.0, 40.0}) {
    const auto points = whole.sample_at(tau);
    CHECK(points.size() == 5);  // two from each msd, and one from the vacf
    CHECK(resumed.sample_at(tau) == points);
  }
}

TEST_CASE("diffusion: a dilute elastic gas diffuses as Enskog's theory says") {
  // 4000 particles: a mean square displacement is known to sqrt(2/(3N)) = 1.3 %, its slope between
  // tau = 5 and 20 to about 1.5 %. Within 7 %, 4.5 standard errors: a false alarm in one of 10^5
  // seeds. The error of the theory is below 1 % at n = 0.01.
  const auto physics = job(0.01, 4000, {"msd@5", "vacf@5"});
  Followed followed(physics, start_of(physics));
  followed.sample_at(5);
  const double early = value_of(followed.sample_at(10), "msd", 5);
  const auto late = followed.sample_at(20);
  const double slope = (value_of(late, "msd", 5) - early) / (6 * 10);
  CHECK(slope == Approx(analysis::self_diffusion_per_collision(0.01)).epsilon(0.07));
  CHECK(value_of(late, "diffusion", 5) == Approx(slope).epsilon(1e-12));
}

TEST_CASE("diffusion: a dense elastic gas diffuses as in published simulations") {
  // This is a sixth more than in Enskog's theory. The standard error is that of the dilute gas,
  // 1.5 %; the published D is that of a large gas, here reduced by 2.837 T/(6 pi eta L)
  // (self_diffusion.hpp). Within 7 %: a false alarm in one of 10^5 seeds; Enskog's D would be off
  // by 12 %.
  const double n = 0.4;
  const auto physics = job(n, 4000, {"msd@20"});
  Followed followed(physics, start_of(physics));
  followed.sample_at(20);
  const double early = value_of(followed.sample_at(30), "msd", 20);
  const double slope = (value_of(followed.sample_at(60), "msd", 20) - early) / (6 * 30);
  const auto transport = analysis::transport(n, 1);
  const double missing = 2.837 / (6 * std::numbers::pi * transport.viscosity *
                                  engine::box_side(n, physics.particles, 3));
  const double expected =
      analysis::simulated_self_diffusion_per_collision(n) - missing / transport.collision_rate;
  CAPTURE(analysis::self_diffusion_per_collision(n));
  CHECK(slope == Approx(expected).epsilon(0.07));
}

TEST_CASE("diffusion: velocities decorrelate as in Enskog's theory") {
  // Within 5/sqrt(3N) = 0.046: a false alarm in one of 10^6 seeds.
  const auto physics = job(0.01, 4000, {"vacf@5"});
  Followed followed(physics, start_of(physics));
  followed.sample_at(5);
  for (const double lag : {0.5, 1.0, 2.0})
    CHECK(std::abs(value_of(followed.sample_at(5 + lag), "vacf", 5) -
                   analysis::enskog_autocorrelation(lag)) < 0.046);
}
