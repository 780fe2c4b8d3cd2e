// SPDX-License-Identifier: GPL-3.0-or-later

// Random input for the real code: grids, states near contact, checkpoints.
//
//   fuzz --seed 7 --rounds 1000
//
// Any input is either used or refused with one of the types of error that callers expect. Anything
// else (a crash, a sanitizer's finding, another exception) ends the program, which then prints the
// seed and the round.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>

#include "campaign/planning/expansion.hpp"
#include "campaign/state/checkpoint.hpp"
#include "campaign/state/restore.hpp"
#include "engine/initial.hpp"
#include "engine/simulation.hpp"
#include "engine/soundness.hpp"
#include "engine/support/random.hpp"
#include "schema/grid/grid.hpp"

using namespace haff;

namespace {

using engine::Random;

std::uint64_t below(Random& random, std::uint64_t end) {
  return random.bits() % end;
}

// ---- grids ------------------------------------------------------------------------------------

std::string value(Random& random, int depth) {
  static const char* const scalars[] = {
      "0.8",     "1",      "-1",    "0",           "1e-4",   "1e300", "0.4",  "1000",
      "2",       "\"tc\"", "{}",    "null",        "true",   "[]",    "50",   "90",
      "\"0.8\"", "1e",     "1e999", "\"\\u0000\"", "1e-400", "1e12",  "1e18", "1e-9"};
  if (depth > 0 && below(random, 3) == 0) {
    std::string list = "[";
    for (std::uint64_t k = below(random, 3); k-- > 0;) list += value(random, depth - 1) + ",";
    return list + value(random, depth - 1) + "]";
  }
  if (depth > 0 && below(random, 4) == 0) {
    static const char* const objects[] = {
        R"({"restitution": {"law": "tc", "t_c": 1e-4}})",
        R"({"restitution": [{"law": "threshold", "speed": [1, 2]}, {"law": "constant"}]})",
        R"([{}, {"shuffle": [{"every": 1}, {"every": [2, 1e-4]}]}])",
        R"({"restitution": {"law": "tc"}})",
        R"({"0.8": 90})",
        R"({"law": "tc", "t_c": []})"};
    return objects[below(random, std::size(objects))];
  }
  return scalars[below(random, std::size(scalars))];
}

std::string grid(Random& random) {
  static const char* const keys[] = {
      "e",           "n",    "N",  "seeds",       "tau_max", "effects", "grids", "sample_every",
      "equilibrate", "name", "nn", "observables", "target",  "$schema", "_",     "profiles_every"};
  std::string text = R"({"e": 0.8, "n": 0.4, "N": 100, "seeds": 1, "tau_max": 20)";
  if (below(random, 2) == 0) text = "{\"e\": " + value(random, 2);
  for (std::uint64_t k = below(random, 5); k-- > 0;)
    text += std::string(", \"") + keys[below(random, std::size(keys))] + "\": " + value(random, 2);
  text += "}";
  for (std::uint64_t k = below(random, 4); k-- > 1;)
    text[below(random, text.size())] = static_cast<char>(below(random, 256));
  return text;
}

// A correct grid, in which a few words and characters are changed.
std::string mutated_grid(Random& random) {
  static const char* const grids[] = {
      R"({"e": [0.8, 0.9], "n": 0.4, "N": 32000, "seeds": 2, "tau_max": {"0.8": 90, "0.9": 180},
          "observables": ["temperature", "laguerre"], "checkpoint_every": 10})",
      R"({"n": 0.05, "N": [500, 1000], "seeds": [3, 4], "tau_max": 40, "equilibrate": 20, "grids": [
          {"e": 0.8, "profiles_every": 10, "fields_at": [20], "observables": ["temperature",
           "distribution", "correlations", "structure", "clusters", "fields"]},
          {"e": 0.9, "d": 2}]})",
      R"({"e": 0.9, "n": 0.4, "N": 4000, "seeds": 5, "tau_max": 60,
          "target": {"a2": {"tau": [5, 15], "se": 5e-4}, "tau_c": {"se": 0.5}}})",
      R"({"e": 0.7, "n": 0.2, "N": 500, "seeds": 1, "tau_max": 20, "sample_every": 0.5, "effects": [
          {}, {"restitution": {"law": ["threshold"], "speed": [0.1, 0.2]}},
          {"shuffle": {"every": [1, 5]}}, {"thermostat": {"rate": 0.05}},
          {"roughness": {"beta": 0.5, "q": 0.4}},
          {"mixture": {"fraction": 0.5, "diameter_ratio": 0.8, "mass_ratio": 0.1}}]})"};
  std::string text = grids[below(random, std::size(grids))];
  for (std::uint64_t k = 1 + below(random, 4); k-- > 0;) {
    const std::size_t at = below(random, text.size());
    const std::size_t begin = text.find_first_of("0123456789\"{[", at);
    if (begin == std::string::npos) continue;
    const std::size_t end = text.find_first_of(",:]} ", begin + 1);
    const std::size_t length = (end == std::string::npos ? text.size() : end) - begin;
    switch (below(random, 5)) {
      case 0:  // replaces a word, most often a number
      case 1:
        text.replace(begin, length, value(random, 1));
        break;
      case 2:
        text.erase(begin, length);
        break;
      case 3:
        text.insert(begin, text.substr(below(random, text.size()), length));
        break;
      default:
        text[at] = static_cast<char>(below(random, 256));
    }
  }
  return text;
}

struct Grids {
  unsigned long tried = 0, accepted = 0;
};
Grids grids_seen;

// An accepted grid is expanded, which must not take for ever.
void try_grid(const std::string& text) {
  constexpr std::size_t many = 2'000'000;  // schema/grid.schema.json allows a million jobs
  ++grids_seen.tried;
  try {
    const auto read =
        schema::parse_grid(text, "fuzz.json", {.bytes = 1e9, .bytes_per_particle = 200});
    if (campaign::expand(read).size() > many) throw std::logic_error("too many jobs: " + text);
    campaign::targets_of(read);
    ++grids_seen.accepted;
  } catch (const schema::GridError&) {
  }
}

// ---- states near contact ----------------------------------------------------------------------

engine::State state_near_contact(Random& random) {
  const auto particles = static_cast<std::uint32_t>(2 + below(random, 60));
  const int d = below(random, 4) == 0 ? 2 : 3;
  engine::State state =
      engine::initial_state(0.02 + 0.5 * random.uniform(), particles, random.bits() >> 11, d);
  // Some pairs are in contact within a few roundings; some velocities are special.
  for (std::uint64_t k = below(random, 6); k-- > 0;) {
    const auto a = below(random, particles), b = below(random, particles);
    const auto axis = below(random, static_cast<std::uint64_t>(d));
    const double step = 1 + (static_cast<double>(below(random, 9)) - 4) * 0x1p-52;
    state.position[b] = state.position[a];
    state.position[b][axis] += below(random, 2) == 0 ? step : 1 + 1e-9 * random.uniform();
    if (state.position[b][axis] >= state.box) state.position[b][axis] -= state.box;
  }
  for (std::uint64_t k = below(random, 6); k-- > 0;) {
    static constexpr double factors[] = {0, -0.0, 1e-8, 1e8, -1, 1e-300};
    for (double& v : state.velocity[below(random, particles)])
      v *= factors[below(random, std::size(factors))];
  }
  return state;
}

engine::Model some_model(Random& random) {
  static constexpr double restitutions[] = {0, 0.05, 0.5, 0.8, 1};
  engine::Model model{.restitution = restitutions[below(random, std::size(restitutions))]};
  if (below(random, 3) == 0) model.law = {"tc", {{"t_c", 1e-3}}};
  if (below(random, 3) == 0) model.law = {"threshold", {{"speed", 1e-2}}};
  return model;
}

void try_state(Random& random) {
  const engine::State start = state_near_contact(random);
  const engine::Model model = some_model(random);
  try {
    engine::Simulation simd(model, start);
    engine::Simulation scalar(model, start, engine::SearchBackend::scalar);
    double before = start.time;
    for (const double tau : {3.0, 10.0, 23.0}) {
      simd.run_to(engine::collisions_at(tau, start.particles()));
      scalar.run_to(engine::collisions_at(tau, start.particles()));
      if (simd.velocities() != scalar.velocities() || simd.positions() != scalar.positions())
        throw std::logic_error("SIMD and scalar engines differ");
      if (!(simd.time() >= before)) throw std::logic_error("time ran backwards");
      before = simd.time();
    }
  } catch (const std::invalid_argument&) {  // refused
  } catch (const engine::PhysicsError&) {
  } catch (const engine::Collapse&) {
  }
}

// ---- checkpoints ------------------------------------------------------------------------------

// Corrects the checksum at the end, so that the bytes behind it are tested.
void reseal(std::vector<std::byte>& bytes) {
  bytes.resize(bytes.size() - sizeof(std::uint64_t));
  const std::uint64_t sum = campaign::checkpoint_checksum(bytes);
  bytes.resize(bytes.size() + sizeof sum);
  std::memcpy(bytes.data() + bytes.size() - sizeof sum, &sum, sizeof sum);
}

void try_checkpoint(Random& random) {
  const schema::Job job{.e = 0.8, .n = 0.4, .particles = 40, .seed = 1};
  engine::State state = engine::initial_state(job.n, job.particles, 1);
  state.memory["last_contact"] = std::vector<double>(job.particles, -1);
  auto bytes = campaign::encode(state);
  for (std::uint64_t k = 1 + below(random, 4); k-- > 0;) {
    const auto at = below(random, bytes.size());
    switch (below(random, 4)) {
      case 0:
        bytes[at] ^= std::byte{1} << below(random, 8);
        break;
      case 1:
        bytes[at] = static_cast<std::byte>(below(random, 256));
        break;
      case 2:
        bytes.resize(std::max<std::size_t>(at, 40));
        break;
      default:
        for (std::size_t c = at; c < std::min(at + 8, bytes.size()); ++c)
          bytes[c] = std::byte{0xff};
    }
  }
  if (below(random, 4) > 0) reseal(bytes);
  try {
    const engine::State read =
        campaign::restore({.tau = 0, .collisions = 0, .state = std::move(bytes)}, job);
    engine::Simulation gas({.restitution = 0.8, .law = {"tc", {{"t_c", 1e-3}}}}, read);
    gas.run_to(engine::collisions_at(1, gas.particles()));
  } catch (const campaign::DamagedCheckpoint&) {
  } catch (const campaign::NewerCheckpoint&) {
  } catch (const engine::PhysicsError&) {
  } catch (const engine::Collapse&) {
  } catch (const std::invalid_argument&) {  // a memory of other particles
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::uint64_t seed = 1;
  std::uint64_t rounds = 100;
  CLI::App app("Tests the real code with random grids, states and checkpoints");
  app.add_option("--seed", seed, "seed of the first round")->capture_default_str();
  bool grids_only = false;
  app.add_flag("--grids", grids_only, "only grids, 40 per round");
  app.add_option("--rounds", rounds, "number of rounds, each with a seed of its own")
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  for (std::uint64_t round = seed; round < seed + rounds; ++round) {
    std::fprintf(stderr, "\rround %llu", static_cast<unsigned long long>(round));
    Random random(round, engine::Stream::velocities);
    try {
      for (int k = 0; k < 20; ++k) try_grid(grid(random));
      for (int k = 0; k < 20; ++k) try_grid(mutated_grid(random));
      if (grids_only) continue;
      try_state(random);
      for (int k = 0; k < 20; ++k) try_checkpoint(random);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "\nfuzz --seed %llu --rounds 1: %s\n",
                   static_cast<unsigned long long>(round), error.what());
      return 1;
    }
  }
  std::fprintf(stderr, "\n%lu of %lu grids accepted\n", grids_seen.accepted, grids_seen.tried);
  return 0;
}
