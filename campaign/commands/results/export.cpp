// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/commands/results/export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <ostream>
#include <stdexcept>
#include <vector>

#include "campaign/base/process/exit_code.hpp"
#include "campaign/base/text/command_text.hpp"
#include "campaign/base/text/job_text.hpp"
#include "campaign/state/restore.hpp"
#include "engine/mixture.hpp"
#include "schema/store/store.hpp"

namespace haff::campaign {
namespace {

constexpr double radius = 0.5;  // of species 1, if there are two [sigma]

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

std::string quoted(const std::string& json) {
  std::string text;
  for (const char c : json) text += c == '"' ? std::string("\\\"") : std::string(1, c);
  return text;
}

std::string head(const engine::State& state, const schema::JobRow& row) {
  const double tau = 2 * static_cast<double>(state.collisions) / state.particles();
  return fmt::format(
      "{}\n{} Properties=id:I:1:pos:R:3:velo:R:3:radius:R:1:species:I:1:mass:R:1{} "
      "job_id={}{} n={} seed={} tau={} Time={} effects=\"{}\"\n",
      state.particles(), cell(state), spins_of(state) ? ":angular_velocity:R:3" : "", row.job_id,
      row.job.e ? fmt::format(" e={}", *row.job.e) : "", row.job.n, row.job.seed, tau, state.time,
      quoted(row.job.effects.text()));
}

std::vector<std::size_t> places_by_id(const engine::State& state) {
  std::vector<std::size_t> places(state.id.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  std::sort(places.begin(), places.end(),
            [&](std::size_t a, std::size_t b) { return state.id[a] < state.id[b]; });
  return places;
}

void write(const engine::State& state, std::ostream& out) {
  constexpr std::size_t chunk = std::size_t{1} << 20;  // [bytes]
  fmt::memory_buffer text;
  const auto flush = [&] {
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
    text.clear();
  };
  const auto mixture = mixture_in(state);
  const auto* spins = spins_of(state);
  for (const std::size_t place : places_by_id(state)) {
    const auto& r = state.position[place];
    const auto& v = state.velocity[place];
    const std::uint32_t id = state.id[place];
    const auto scaled = [&](double value) { return std::ldexp(value, -state.exponent); };
    fmt::format_to(std::back_inserter(text), "{} {} {} {} {} {} {} {} {} {}", id, r[0], r[1], r[2],
                   scaled(v[0]), scaled(v[1]), scaled(v[2]),
                   mixture ? radius * mixture->diameter_of(id) : radius,
                   mixture && mixture->is_second(id) ? 2 : 1, mixture ? mixture->mass_of(id) : 1.0);
    if (spins != nullptr)
      for (std::size_t axis = 0; axis < 3; ++axis)
        fmt::format_to(std::back_inserter(text), " {}", scaled(spins->at(3 * id + axis)));
    text.push_back('\n');
    if (text.size() > chunk) flush();
  }
  flush();
}

}  // namespace

int export_state(const std::filesystem::path& path, std::int64_t job_id, std::ostream& out) {
  const schema::Reader store(path);
  const schema::JobRow row = store.job(job_id);
  const auto state = newest_state(store, job_id, row.job);
  if (!state)
    throw schema::NameError(fmt::format(
        "{}: no state of job {} ({}) is stored yet; run it at least to its first "
        "checkpoint, tau = {}, with: {}",
        path.string(), job_id, describe(row.job), row.checkpoint_every, command_text("run", path)));
  out << head(*state, row);
  write(*state, out);
  out.flush();
  if (!out) throw std::runtime_error("the state could not be written; is the disk full?");
  return exit_complete;
}

}  // namespace haff::campaign
