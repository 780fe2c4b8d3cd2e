// SPDX-License-Identifier: GPL-3.0-or-later

// What a job starts from: the key start of a grid.
//
//   uniform           the usual: the gas at the end of its equilibration
//   crystal           a lattice with Gaussian velocities, as it is, without an equilibration
//   shear wave        the equilibrated gas, flowing along x as A sin(2 pi waves y / L)
//   two temperatures  the equilibrated gas, one half of it hotter: species 1 of a mixture,
//   otherwise
//                     the half of the box at x < L/2
//   file              a state of the user's own, which the store holds
//
// In all of them the total momentum is 0, and the energy per particle 1.
#pragma once

#include <filesystem>
#include <string>

namespace haff::schema {

struct Start {
  enum class Kind { uniform, crystal, shear_wave, two_temperatures, file };

  Kind kind = Kind::uniform;
  double amplitude = 0;     // A of a shear wave [sqrt(E(0)/m)]
  int waves = 0;            // of a shear wave
  double ratio = 0;         // of two temperatures
  std::string digest = {};  // of the state that a file holds, 16 hexadecimal digits

  bool is_uniform() const { return kind == Kind::uniform; }
  // Whether an elastic gas is equilibrated first.
  bool is_equilibrated() const { return kind != Kind::crystal && kind != Kind::file; }
  // Whether the gas flows, or is hotter in one place than in another: its energy then falls by more
  // than collisions of a uniform gas take.
  bool is_driven_apart() const {
    return kind == Kind::shear_wave || kind == Kind::two_temperatures;
  }

  bool operator==(const Start&) const = default;
};

// As in a job's identity and the column jobs.start, where a uniform start is not written: "crystal"
// with its quotes, {"shear wave":{"amplitude":0.5,"waves":1}}, {"two temperatures":{"ratio":4}},
// {"file":"0123456789abcdef"}. And back; throws std::invalid_argument or what nlohmann::json
// throws.
std::string start_text(const Start& start);
Start start_in(const std::string& text);

// As a grid asks for it.
struct AskedStart {
  Start start;                      // of a file without its digest
  std::filesystem::path file = {};  // absolute, or relative to the folder of the grid
  std::string place = {};  // of the name of the file, for messages: "grid.json: /start/file"
};

// What a shear wave and two temperatures are like unless a grid says otherwise.
inline constexpr double usual_amplitude = 0.5;
inline constexpr int usual_waves = 1;
inline constexpr double usual_ratio = 4;

// A wave of a larger amplitude would hold all the energy: A^2/4 of 1.
inline constexpr double largest_amplitude = 1.9;

}  // namespace haff::schema
