// SPDX-License-Identifier: GPL-3.0-or-later

// The plot that answers a question.
#pragma once

#include <string>
#include <vector>

#include "campaign/curves/question.hpp"
#include "campaign/plot/plot.hpp"
#include "schema/store/store.hpp"

namespace haff::campaign {

struct Answer {
  Plot plot;
  std::vector<std::string> notes = {};  // sentences about what is not in the plot
};

// One panel with a curve for each gas, or for the gases that differ in nothing but the variable.
// Points are means over realizations, and errors those of results/averages.hpp. Throws
// QuestionError, NothingToDraw, schema::QueryError and the errors of the store.
Answer answer(const schema::Reader& store, const Question& question);

}  // namespace haff::campaign
