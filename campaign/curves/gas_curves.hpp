// SPDX-License-Identifier: GPL-3.0-or-later

// From realizations to the curves of gases: means or paired differences, with errors.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "campaign/curves/question.hpp"
#include "campaign/curves/scene.hpp"
#include "schema/store/store.hpp"

namespace haff::campaign {

// A gas, and what it is compared with.
struct Gas {
  schema::Job job;
  std::optional<schema::Job> reference = {};
};

struct CurvePoint {
  double x = 0, y = 0;
  double error = 0;  // as in Means (results/averages.hpp); NaN: none
  std::int64_t realizations = 0;
  std::size_t gas = 0;  // of the curve's gases
};

// A curve of one gas along its runs; or of several gases, a point each, that differ only in the
// parameters that the variable is made of.
struct GasCurve {
  Scene scene;  // without parameters of which the variable is made
  std::vector<Gas> gases = {};
  std::vector<CurvePoint> points = {};  // by x, or along the run

  std::int64_t most_realizations() const;
  std::int64_t fewest_realizations() const;
};

struct GasCurves {
  std::vector<GasCurve> all = {};  // each has points
  std::set<std::string> code_versions = {};
  std::vector<std::string> notes = {};  // sentences about gases that are left out
};

// Throws NothingToDraw, with the reason, and what reading the store throws.
GasCurves gas_curves(const schema::Reader& store, const Vocabulary& words, const Topic& topic,
                     const Question& question);

// Whether the topic's curves are along runs, and not of many gases.
bool is_along_runs(const Topic& topic);

}  // namespace haff::campaign
