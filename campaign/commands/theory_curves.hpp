// The theory curves that the program knows, by name: what they are functions of, which columns they
// have, and how they are computed. All of it is in analysis/; this is the list.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/direct/direct_simulation.hpp"

namespace haff::campaign {

// What a curve may be asked for with. Values that it does not use are left alone.
struct TheoryPoint {
  int d = 3;
  double n = 0.4;
  double e = 0.85;
  double b = 0.30;         // of the cutoff k_M of Tr G^+
  double tau = 50;         // of a curve in r
  bool other_law = false;  // an effect was asked for: the direct simulation alone knows it
  analysis::HomogeneousGas gas;
  analysis::SimulationSize size;
};

struct TheoryTable {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;
};

struct TheoryCurve {
  std::string_view name;
  std::string_view variable;  // tau, r, k, e or n
  std::string_view meaning;
  TheoryTable (*compute)(const TheoryPoint& at, std::span<const double> values);
};

std::span<const TheoryCurve> theory_curves();

// Nullptr if there is none of this name.
const TheoryCurve* theory_curve(std::string_view name);

}  // namespace haff::campaign
