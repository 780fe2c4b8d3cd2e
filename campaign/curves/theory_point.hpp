// SPDX-License-Identifier: GPL-3.0-or-later

// The gas that a theory curve is asked of, with the effects of a grid or a job.
#pragma once

#include <stdexcept>
#include <string>

#include "campaign/curves/theory_curves.hpp"
#include "schema/grid/job.hpp"

namespace haff::campaign {

// The question names no curve, or there is no theory for it.
struct TheoryError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Adds effects, a JSON object as in a grid without lists, to a point whose d, e and n are known.
// Throws TheoryError for those that no theory here treats.
void add_effects(const schema::Effects& effects, TheoryPoint& at);
void add_effects(const std::string& json, TheoryPoint& at);

// The point of a job's gas. Likewise.
TheoryPoint theory_point(const schema::Job& job);

// Whether the curve is one of this gas.
bool knows(const TheoryCurve& curve, const TheoryPoint& at);

}  // namespace haff::campaign
