// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/planning/given_states.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <memory>
#include <span>
#include <stdexcept>
#include <vector>

#include "campaign/state/checkpoint.hpp"
#include "campaign/state/extended_xyz.hpp"
#include "campaign/state/first_state.hpp"
#include "schema/digests/checksum.hpp"

namespace haff::campaign {
namespace {

// Of the numbers alone: neither the version of a checkpoint nor the name of the file is in it.
std::string digest_of(const engine::State& state) {
  std::vector<double> numbers{static_cast<double>(state.d), state.box};
  for (std::size_t k = 0; k < state.id.size(); ++k) {
    numbers.push_back(state.id[k]);
    numbers.insert(numbers.end(), state.position[k].begin(), state.position[k].end());
    numbers.insert(numbers.end(), state.velocity[k].begin(), state.velocity[k].end());
  }
  if (const auto spins = state.memory.find("spin"); spins != state.memory.end())
    numbers.insert(numbers.end(), spins->second.begin(), spins->second.end());
  return fmt::format("{:016x}", schema::checksum(std::as_bytes(std::span(numbers))));
}

}  // namespace

GivenState GivenStates::state_of(const schema::AskedStart& asked, const schema::Job& job) {
  schema::Job gas = equilibration_of(job);
  gas.effects = job.effects;
  const std::string key = asked.file.string() + "\n" + schema::identity(gas);
  if (const auto known = known_.find(key); known != known_.end()) return known->second;
  const auto refuse = [&](const std::string& why) {
    return schema::GridError(fmt::format("{}: {}: {}", asked.place, asked.file.string(), why));
  };
  std::ifstream file(asked.file);
  if (!file) throw refuse(fmt::format("cannot be read: {}", std::strerror(errno)));
  try {
    const engine::State state = given_state(read_xyz(file), job);
    return known_[key] = {.digest = digest_of(state),
                          .state = std::make_shared<schema::Checkpoint>(schema::Checkpoint{
                              .tau = 0, .collisions = 0, .state = encode(state)})};
  } catch (const std::invalid_argument& wrong) {
    throw refuse(wrong.what());
  }
}

}  // namespace haff::campaign
