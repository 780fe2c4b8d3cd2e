// SPDX-License-Identifier: GPL-3.0-or-later

// The list of the theory curves by name: their variables, their columns, and the functions of
// analysis/ that compute them.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/direct/direct_simulation.hpp"
#include "analysis/theory/correlations.hpp"
#include "analysis/theory/mixture.hpp"
#include "analysis/theory/rough_spheres.hpp"

namespace haff::campaign {

// What a curve may be asked for with. Values that it does not use are left alone.
struct TheoryPoint {
  int d = 3;
  double n = 0.4;
  double e = 0.85;
  double b = analysis::cutoff_b;  // of the cutoff k_M of Tr G^+
  double tau = 50;                // of a curve in r
  bool other_law = false;    // another law of restitution, or heating: the direct simulation alone
                             // knows it
  bool is_shuffled = false;  // no correlations of velocities: theory without them is all there is
  std::optional<analysis::Roughness> roughness = {};
  std::optional<analysis::BinaryMixture> mixture = {};
  // Whether a direct simulation may be computed where the table has none: it takes some seconds.
  bool may_compute = true;
  analysis::HomogeneousGas gas;
  analysis::SimulationSize size;
};

struct TheoryTable {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;
};

// The gases that a curve is of: smooth spheres of constant e whose velocities are correlated, the
// same with or without a shuffle, also those of another law of restitution or with a thermostat,
// also rough ones, those alone, or mixtures.
enum class Treats { correlated, smooth, any_law, any_law_or_rough, rough, mixture };

struct TheoryCurve {
  std::string_view name;
  std::string_view variable;  // tau, r, k, e or n
  std::string_view meaning;
  Treats treats;
  TheoryTable (*compute)(const TheoryPoint& at, std::span<const double> values);
};

std::span<const TheoryCurve> theory_curves();

// Nullptr if there is none of this name.
const TheoryCurve* theory_curve(std::string_view name);

}  // namespace haff::campaign
