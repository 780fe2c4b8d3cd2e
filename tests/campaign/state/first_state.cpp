// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/state/first_state.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>

#include "engine/initial.hpp"
#include "engine/mixture.hpp"
#include "engine/soundness.hpp"

using namespace haff;
using namespace haff::campaign;

namespace {

schema::Job job_of(std::uint32_t particles = 500, int d = 3) {
  schema::Job job;
  job.d = d;
  job.n = 0.3;
  job.particles = particles;
  job.seed = 1;
  return job;
}

engine::State gas_of(const schema::Job& job, const char* effects = "") {
  std::map<std::string, engine::Parameters> all;
  if (std::string(effects) == "mixture")
    all = {{"mixture", {{"fraction", 0.25}, {"diameter_ratio", 0.8}, {"mass_ratio", 0.1}}}};
  return engine::initial_state(job.n, job.particles, job.seed, job.d, all);
}

double mass_of(const engine::State& state, std::size_t k) {
  const auto mixture = mixture_in(state);
  return mixture ? mixture->mass_of(state.id[k]) : 1;
}

double energy_of(const engine::State& state) {
  double sum = 0;
  for (std::size_t k = 0; k < state.id.size(); ++k)
    for (const double v : state.velocity[k]) sum += 0.5 * mass_of(state, k) * v * v;
  return sum / state.particles();
}

double momentum_of(const engine::State& state) {
  double largest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double sum = 0;
    for (std::size_t k = 0; k < state.id.size(); ++k)
      sum += mass_of(state, k) * state.velocity[k][axis];
    largest = std::max(largest, std::abs(sum));
  }
  return largest / state.particles();
}

std::string written(const engine::State& state) {
  std::ostringstream out;
  write_xyz(state, "tau=0", out);
  return out.str();
}

engine::State read(const std::string& text, const schema::Job& job) {
  std::istringstream in(text);
  return given_state(read_xyz(in), job);
}

std::string refusal(const std::string& text, const schema::Job& job) {
  try {
    read(text, job);
  } catch (const std::invalid_argument& wrong) {
    return wrong.what();
  }
  return "not refused";
}

std::string with(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

}  // namespace

TEST_CASE("first state: a shear wave has exactly its amplitude, energy 1 and no momentum") {
  for (const int d : {2, 3})
    for (const char* effects : {"", "mixture"}) {
      const schema::Job job = job_of(2000, d);
      const engine::State before = engine::restarted(gas_of(job, effects));
      const schema::Start start{
          .kind = schema::Start::Kind::shear_wave, .amplitude = 0.7, .waves = 2};
      const engine::State state = first_state(before, start);
      // Rounding in sums of 2000 terms.
      CHECK(std::abs(energy_of(state) - 1) < 1e-13);
      CHECK(momentum_of(state) < 1e-14);
      CHECK(state.position == before.position);
      // The thermal velocity of every particle is multiplied by f, and the rest is the wave.
      const double f = state.velocity[0][1] / before.velocity[0][1];
      double largest = 0;
      Frame unused;
      double mean = 0, mass = 0;
      for (std::size_t k = 0; k < state.id.size(); ++k) {
        mean +=
            mass_of(state, k) * std::sin(4 * std::numbers::pi * state.position[k][1] / state.box);
        mass += mass_of(state, k);
      }
      mean /= mass;
      for (std::size_t k = 0; k < state.id.size(); ++k) {
        const double wave =
            0.7 * (std::sin(4 * std::numbers::pi * state.position[k][1] / state.box) - mean);
        largest =
            std::max(largest, std::abs(state.velocity[k][0] - wave - f * before.velocity[k][0]));
        largest = std::max(largest, std::abs(state.velocity[k][1] - f * before.velocity[k][1]));
      }
      CHECK(largest < 1e-13);
    }
}

TEST_CASE("first state: two temperatures have exactly their ratio, and neither half flows") {
  for (const double ratio : {4.0, 0.1}) {
    const schema::Job job = job_of(1000);
    const engine::State before = gas_of(job);
    const engine::State state =
        first_state(before, {.kind = schema::Start::Kind::two_temperatures, .ratio = ratio});
    double energy[2] = {}, flow[2] = {}, count[2] = {};
    for (std::size_t k = 0; k < state.id.size(); ++k) {
      const int half = state.position[k][0] < 0.5 * state.box ? 0 : 1;
      ++count[half];
      flow[half] += state.velocity[k][0];
      for (const double v : state.velocity[k]) energy[half] += v * v;
    }
    CHECK(energy[0] / count[0] / (energy[1] / count[1]) == doctest::Approx(ratio).epsilon(1e-12));
    CHECK(std::abs(flow[0]) + std::abs(flow[1]) < 1e-10);
    CHECK(energy_of(state) == doctest::Approx(1).epsilon(1e-13));
  }
}

TEST_CASE("first state: the temperatures of a mixture are those of its species") {
  const schema::Job job = job_of(1000);
  const engine::State state = first_state(
      gas_of(job, "mixture"), {.kind = schema::Start::Kind::two_temperatures, .ratio = 4});
  double energy[2] = {}, count[2] = {};
  for (std::size_t k = 0; k < state.id.size(); ++k) {
    const int species = mixture_in(state)->is_second(state.id[k]) ? 1 : 0;
    ++count[species];
    for (const double v : state.velocity[k]) energy[species] += mass_of(state, k) * v * v;
  }
  CHECK(energy[0] / count[0] / (energy[1] / count[1]) == doctest::Approx(4).epsilon(1e-12));
  CHECK(momentum_of(state) < 1e-14);
}

TEST_CASE("a state of the user's own: a written state is read back in every bit") {
  for (const int d : {2, 3}) {
    const schema::Job job = job_of(500, d);
    const engine::State state = engine::restarted(gas_of(job));
    const engine::State again = read(written(state), job);
    CHECK(again.box == state.box);
    // The order is that of the file, which is that of ids. The energy is 1 up to rounding, and is
    // set to 1 again.
    for (std::size_t k = 0; k < state.id.size(); ++k) {
      const std::uint32_t id = state.id[k];
      CHECK(again.id[id] == id);
      CHECK(again.position[id] == state.position[k]);
      for (std::size_t axis = 0; axis < 3; ++axis)
        CHECK(std::abs(again.velocity[id][axis] - state.velocity[k][axis]) < 1e-14);
    }
    CHECK(read(written(again), job).id == again.id);
  }
}

TEST_CASE("a state of the user's own: momentum is removed, and the energy is set to 1") {
  const schema::Job job = job_of();
  engine::State state = gas_of(job);
  for (auto& v : state.velocity)
    for (double& component : v) component = 3 * component + 5;
  const engine::State read_back = read(written(state), job);
  CHECK(momentum_of(read_back) < 1e-14);
  CHECK(energy_of(read_back) == doctest::Approx(1).epsilon(1e-13));
}

TEST_CASE("a state of the user's own: species and spins") {
  schema::Job job = job_of();
  job.effects =
      R"({"mixture":{"diameter_ratio":0.8,"fraction":0.25,"mass_ratio":0.1},"roughness":{"beta":0.5,"q":0.4}})";
  engine::State state = gas_of(job, "mixture");
  state.memory["spin"] = std::vector<double>(1500, 0.25);
  const engine::State again = read(written(state), job);
  CHECK(mixture_in(again) == mixture_in(state));
  const double spin = again.memory.at("spin")[7];
  // Translation and rotation together have the energy 1.
  CHECK(energy_of(again) + 0.5 * 0.4 * 3 * spin * spin * (0.75 + 0.25 * 0.1) ==
        doctest::Approx(1).epsilon(1e-12));
}

TEST_CASE("a state that does not belong to the job is refused, with the line") {
  const schema::Job job = job_of(4);
  const std::string head =
      "4\nLattice=\"2.3712622029933753 0 0 0 2.3712622029933753 0 0 0 2.3712622029933753\" "
      "Properties=pos:R:3:velo:R:3 pbc=\"T T T\"\n";
  const std::string sound =
      head + "0 0 0 1 0 0\n1.1 1.1 0 -1 0 0\n1.1 0 1.1 0 1 0\n0 1.1 1.1 0 0 -2\n";
  CHECK(refusal(sound, job) == "not refused");
  CHECK(refusal(with(sound, "1.1 1.1 0 -1", "0.5 0.5 0 -1"), job).find("overlap by 0.293 sigma") !=
        std::string::npos);
  CHECK(refusal(with(sound, "-1 0 0\n", "nan 0 0\n"), job) == "line 4: 'nan' is no finite number");
  CHECK(refusal(with(sound, "-1 0 0\n", "1e999 0 0\n"), job).starts_with("line 4: '1e999'"));
  CHECK(refusal(with(sound, "-1 0 0\n", "-1 0\n"), job) == "line 4: has 5 columns, and 6 expected");
  CHECK(refusal(with(sound, "4\n", "5\n"), job) == "line 7: is missing: 5 particles expected");
  CHECK(refusal(with(sound, "4\n", "3\n"), job).starts_with("holds more than one gas"));
  CHECK(refusal(with(sound, "Lattice=\"2.37126", "Lattice=\"3.37126"), job)
            .find("its cell has a side of 3.37126") != std::string::npos);
  CHECK(refusal(with(sound, "T T T", "T F T"), job) ==
        "its cell is not periodic (pbc) along each axis");
  CHECK(refusal(with(sound, "Properties=", "Columns="), job)
            .starts_with("line 2: has no Properties"));
  CHECK(refusal(with(sound, "velo:R:3", "speed:R:3"), job)
            .starts_with("line 2: Properties have no pos:R:3 and velo:R:3"));
  CHECK(refusal("", job) == "line 1: is empty; expected extended XYZ");
  CHECK(refusal("x", job) == "line 1: 'x' is no number of particles");
  CHECK(refusal(head + "0 0 0 1 0 0\n1.1 1.1 0 1 0 0\n1.1 0 1.1 1 0 0\n0 1.1 1.1 1 0 0\n", job)
            .find("do not move against each other") != std::string::npos);
  CHECK(refusal(sound, job_of(5)).starts_with("holds 4 particles, and the grid asks for 5"));
  CHECK(refusal(with(sound, "Properties=pos:R:3:velo:R:3", "Properties=pos:R:3:velo:R:2:mass:R:1"),
                job) == "line 2: the column velo has 2 numbers, and 3 expected");
}
