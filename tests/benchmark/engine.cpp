// SPDX-License-Identifier: GPL-3.0-or-later

// Measures the speed of the engine: collisions per second of a gas that has been warmed up.
//
//   engine_benchmark --N 4000 --n 0.4 --e 1 --warmup 20 --tau 20 --json
//
// Prints the rate (synchronizations included), events by kind, memory and a hash of the final
// state: two builds that print the same hash have computed the same trajectory.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>

#include "engine/initial.hpp"
#include "engine/simulation.hpp"

using namespace haff;

namespace {

// FNV-1a over the bits of all velocities.
std::string state_hash(const engine::Simulation& gas) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const engine::Vector& v : gas.velocities())
    for (const double component : v) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &component, sizeof bits);
      hash = (hash ^ bits) * 0x100000001b3u;
    }
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

// The memory of laws and effects, in bytes; known only at a synchronization.
std::size_t remembered(const engine::Simulation& gas) {
  std::size_t bytes = 0;
  if (gas.synchronized())
    for (const auto& [name, values] : gas.state().memory) bytes += values.size() * sizeof(double);
  return bytes;
}

engine::Model model(double e, std::uint64_t seed, const std::string& text) {
  engine::Model model{.restitution = e, .seed = seed};
  const auto effects = nlohmann::json::parse(text);
  for (const auto& [effect, asked] : effects.items())
    for (const auto& [key, value] : asked.items())
      if (key == "law")
        model.law.name = value.get<std::string>();
      else
        (effect == "restitution" ? model.law.parameters : model.effects[effect])[key] =
            value.get<double>();
  return model;
}

}  // namespace

int main(int argc, char** argv) {
  std::uint32_t particles = 4000;
  double n = 0.4;
  double e = 1;
  int d = 3;
  std::uint64_t seed = 1;
  double warmup = 20;
  double tau = 20;
  std::string effects = "{}";
  bool scalar = false;
  engine::Threads threads;
  bool json = false;
  CLI::App app("Collisions per second of the event-driven engine");
  app.add_option("--N", particles, "particles")->capture_default_str();
  app.add_option("--n", n, "number density")->capture_default_str();
  app.add_option("--d", d, "dimension, 2 or 3")->capture_default_str();
  app.add_option("--e", e, "restitution coefficient")->capture_default_str();
  app.add_option("--seed", seed, "realization")->capture_default_str();
  app.add_option("--warmup", warmup, "elastic collisions per particle before")
      ->capture_default_str();
  app.add_option("--tau", tau, "collisions per particle measured")->capture_default_str();
  app.add_flag("--scalar", scalar, "predict contacts one by one, without SIMD");
  app.add_option("--threads", threads.count, "threads that work on the one gas")
      ->capture_default_str();
  app.add_option("--slabs", threads.slabs, "slabs of the box; 0: as many as threads")
      ->capture_default_str();
  app.add_option("--window", threads.window,
                 "length of a window of several threads, in collisions per particle; 0: adapted")
      ->capture_default_str();
  app.add_flag("--json", json, "print one JSON object");
  app.add_option("--effects", effects, "as in a grid, JSON")->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  const auto backend = scalar ? engine::SearchBackend::scalar : engine::SearchBackend::simd;
  const engine::Model asked = model(e, seed, effects);
  engine::State start = engine::initial_state(n, particles, seed, d, asked.effects);
  if (warmup > 0) {
    // A state exists only at a synchronization.
    const double period = engine::synchronization_period;
    engine::Model elastic{.restitution = 1};
    if (const auto mixture = asked.effects.find("mixture"); mixture != asked.effects.end())
      elastic.effects.insert(*mixture);
    engine::Simulation melting(elastic, start, backend, threads);
    melting.run_to(engine::collisions_at(period * std::ceil(warmup / period), particles));
    start = engine::restarted(melting.state());
  }
  engine::Simulation gas(asked, start, backend, threads);
  start = {};
  const auto begin = std::chrono::steady_clock::now();
  gas.run_to(engine::collisions_at(tau, particles));
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;

  const engine::Events events = gas.events();
  const auto collisions = static_cast<double>(events.collisions);
  nlohmann::ordered_json result{
      {"d", d},
      {"N", particles},
      {"n", n},
      {"e", e},
      {"seed", seed},
      {"tau", tau},
      {"simd", scalar ? "none" : engine::simd_target()},
      {"seconds", seconds.count()},
      {"collisions_per_second", collisions / seconds.count()},
      {"crossings_per_collision", static_cast<double>(events.crossings) / collisions},
      {"stale_per_collision", static_cast<double>(events.stale) / collisions},
      {"bytes_per_particle", static_cast<double>(gas.memory() + remembered(gas)) / particles},
      {"state_hash", state_hash(gas)}};
  if (const auto windows = gas.windows()) {
    const auto count = static_cast<double>(windows->count);
    const auto all = static_cast<double>(windows->in_slabs + windows->in_zones);
    result["windows"] = windows->count;
    result["repaired"] = static_cast<double>(windows->repaired) / count;
    result["in_one_piece"] = static_cast<double>(windows->in_one_piece) / collisions;
    result["events_per_window"] = all / count;
    result["in_zones"] = static_cast<double>(windows->in_zones) / all;
    result["busiest_thread"] = static_cast<double>(windows->longest) / all;
  }
  if (json) {
    std::printf("%s\n", result.dump().c_str());
  } else {
    for (const auto& [key, value] : result.items())
      std::printf("%-22s %s\n", key.c_str(), value.dump().c_str());
  }
  return 0;
}
