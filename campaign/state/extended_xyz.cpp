// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/state/extended_xyz.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>
#include <ostream>
#include <vector>

#include "engine/mixture.hpp"

namespace haff::campaign {
namespace {

constexpr double radius = 0.5;  // of species 1, if there are two [sigma]
constexpr std::array<const char*, 2> elements{"H", "He"};

// The box and its periods; disks lie in the middle of a layer one diameter high.
std::string cell(const engine::State& state) {
  if (state.d == 2)
    return fmt::format(R"(Lattice="{0} 0 0 0 {0} 0 0 0 1" Origin="0 0 -0.5" pbc="T T F")",
                       state.box);
  return fmt::format(R"(Lattice="{0} 0 0 0 {0} 0 0 0 {0}" Origin="0 0 0" pbc="T T T")", state.box);
}

// Angular velocities of rough particles, three numbers each by id, scaled like the velocities.
const std::vector<double>* spins_of(const engine::State& state) {
  const auto found = state.memory.find("spin");
  return found == state.memory.end() ? nullptr : &found->second;
}

std::vector<std::size_t> places_by_id(const engine::State& state) {
  std::vector<std::size_t> places(state.id.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  std::sort(places.begin(), places.end(),
            [&](std::size_t a, std::size_t b) { return state.id[a] < state.id[b]; });
  return places;
}

}  // namespace

std::string quoted_for_xyz(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\\\"") : std::string(1, c);
  return quoted + '"';
}

void write_xyz(const engine::State& state, const std::string& facts, std::ostream& out) {
  constexpr std::size_t chunk = std::size_t{1} << 20;  // [bytes]
  fmt::memory_buffer text;
  const auto flush = [&] {
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
    text.clear();
  };
  const auto mixture = mixture_in(state);
  const auto* spins = spins_of(state);
  fmt::format_to(std::back_inserter(text),
                 "{}\n{} Properties=species:S:1:pos:R:3:velo:R:3:radius:R:1:mass:R:1:id:I:1{} {}\n",
                 state.particles(), cell(state), spins ? ":angular_velocity:R:3" : "", facts);
  for (const std::size_t place : places_by_id(state)) {
    const auto& r = state.position[place];
    const auto& v = state.velocity[place];
    const std::uint32_t id = state.id[place];
    const auto scaled = [&](double value) { return std::ldexp(value, -state.exponent); };
    fmt::format_to(std::back_inserter(text), "{} {} {} {} {} {} {} {} {} {}",
                   elements.at(mixture && mixture->is_second(id) ? 1 : 0), r[0], r[1], r[2],
                   scaled(v[0]), scaled(v[1]), scaled(v[2]),
                   mixture ? radius * mixture->diameter_of(id) : radius,
                   mixture ? mixture->mass_of(id) : 1.0, id);
    if (spins != nullptr)
      for (std::size_t axis = 0; axis < 3; ++axis)
        fmt::format_to(std::back_inserter(text), " {}", scaled(spins->at(3 * id + axis)));
    text.push_back('\n');
    if (text.size() > chunk) flush();
  }
  flush();
}

}  // namespace haff::campaign
