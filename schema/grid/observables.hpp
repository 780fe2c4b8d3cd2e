// SPDX-License-Identifier: GPL-3.0-or-later

// The observables of a grid, and the curves that they leave in the table profiles, once for all. A
// new observable is a line in each of the two tables of observables.cpp and its name in
// grid.schema.json; CONTRIBUTING.md says where it is measured.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace haff::schema {

// When an observable is taken: with every sample, every profiles_every, or at fields_at.
enum class Taken { with_samples, with_profiles, with_fields };

struct Observable {
  std::string_view name;
  Taken taken = Taken::with_samples;
  double widest_refused_box = 0;  // the measurement needs a box wider than this [sigma]
};
std::span<const Observable> observables();

// Of "msd@20" that of msd. Null if there is none of this name.
const Observable* find_observable(std::string_view name);

// 20 of "msd@20", the waiting time; 0 of "msd"; nothing of an observable without one.
std::optional<double> waiting_time(std::string_view observable);

// A curve in the table profiles.
struct Curve {
  std::string_view name;
  std::string_view observable;
  std::string_view variable;  // as axes call it
  std::string_view meaning;
};
std::span<const Curve> curves();

// Null if there is none of this name.
const Curve* find_curve(std::string_view name);

}  // namespace haff::schema
