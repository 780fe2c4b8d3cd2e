// SPDX-License-Identifier: GPL-3.0-or-later

// The only list of the observables of a grid, and of the curves that they leave in the table
// profiles. A new observable is a line in each of the two tables of observables.cpp and its name in
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

// The observable of this name, msd for "msd@20"; null if there is none.
const Observable* find_observable(std::string_view name);

// The waiting time: 20 for "msd@20", 0 for "msd", nothing for an observable without one.
std::optional<double> waiting_time(std::string_view observable);

// A curve in the table profiles.
struct Curve {
  std::string_view name;
  std::string_view observable;
  std::string_view variable;  // the name of x on an axis
  std::string_view meaning;
};
std::span<const Curve> curves();

// Null if there is none of this name.
const Curve* find_curve(std::string_view name);

}  // namespace haff::schema
