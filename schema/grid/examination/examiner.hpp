// SPDX-License-Identifier: GPL-3.0-or-later

// The rules of a grid that a JSON schema cannot express: what fits into a box (box.hpp), what goes
// together (combinations.hpp), what lies on the axis of tau (tau.hpp), which targets can be reached
// (targets.hpp), and, here, that nothing is said twice, left out, or too much. Private to schema/.
#pragma once

#include <string>
#include <vector>

#include "schema/grid/grid.hpp"
#include "schema/grid/source.hpp"

namespace haff::schema {

struct ExaminedGrid {
  std::vector<Source> sources;
  std::vector<std::vector<double>> tau_max;  // of each source, in the order of its e
};

// Examines a document that keeps the rules of grid.schema.json. Throws GridError, which names the
// place in the file. The result refers to the document.
ExaminedGrid examine(const Json& document, const std::string& file, const Memory& memory,
                     const Refusal& cannot_start);

}  // namespace haff::schema
