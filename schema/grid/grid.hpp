// SPDX-License-Identifier: GPL-3.0-or-later

// A grid file: what a user asks for, read, validated and made explicit (grid.schema.json).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "schema/grid/effects.hpp"
#include "schema/grid/moments.hpp"
#include "schema/grid/start.hpp"
#include "schema/grid/target.hpp"

namespace haff::schema {

// Something is wrong with a grid file. The message names the file, the JSON pointer (or line and
// column), the value and what was expected.
struct GridError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// One entry of "grids" with all defaults filled in: the product of these lists. No list but e is
// empty or holds a value twice.
struct SubGrid {
  std::vector<int> d;
  std::vector<double> e;                 // empty where the law of restitution has none
  std::vector<double> n;                 // [sigma^-d]
  std::vector<std::uint32_t> particles;  // N
  std::vector<std::uint64_t> seeds;
  std::vector<double> tau_max;  // as long as e, or one: how far each is run [collisions/particle]
  std::vector<double> sample_every;
  Schedule sample_at;
  std::vector<AskedStart> starts;
  std::vector<double> equilibrate;
  double checkpoint_every = 0;
  std::vector<std::string> observables;  // sorted
  std::optional<double> profiles_every;  // where an observable is a profile
  std::vector<double> fields_at;         // increasing; where fields are an observable
  Schedule snapshots_at;
  std::vector<Effects> effects;  // each as in Job::effects
  std::vector<Target> targets;   // of each of its series; seeds are the pilot runs
};

struct Grid {
  std::string name;  // empty if not given
  std::vector<SubGrid> grids;
};

// What the machine can hold.
struct Memory {
  double bytes = 0;               // of the machine
  double bytes_per_particle = 0;  // of a running job
};

// A gas to be prepared: at n = 0.4 and d = 3 its packing is 0.209.
struct Preparation {
  int d = 3;
  double n = 0;
  std::uint32_t particles = 0;
  double packing = 0;       // the part of the volume that the particles fill
  bool is_mixed = false;    // whether particles differ in size
  bool on_lattice = false;  // whether it must be a lattice: the start is a crystal
};

// Why a gas cannot be prepared, e.g. "particles ... ; expected ...", or nothing if it can. Only the
// engine knows.
using Refusal = std::function<std::optional<std::string>(const Preparation&)>;

// Reads and checks a grid file. Throws GridError.
Grid read_grid(const std::filesystem::path& path, const Memory& memory,
               const Refusal& cannot_start = {});

// The same for a text, which messages call `file`.
Grid parse_grid(std::string_view text, const std::string& file, const Memory& memory,
                const Refusal& cannot_start = {});

}  // namespace haff::schema
