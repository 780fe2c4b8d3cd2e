// SPDX-License-Identifier: GPL-3.0-or-later

// From a grid to jobs: the product of its lists, each job once, with the equilibrations they need.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "schema/grid/grid.hpp"
#include "schema/store/store.hpp"

namespace haff::campaign {

// A state that a start from a file names (given_states.hpp).
struct GivenState {
  std::string digest = {};
  std::shared_ptr<const schema::Checkpoint> state = {};
};
using ReadState = std::function<GivenState(const schema::AskedStart&, const schema::Job&)>;

// Cooling jobs in the order of the grid, each preceded by its equilibration where that is new.
// A job named twice is one with the larger tau_max and the closer checkpoints.
std::vector<schema::Planned> expand(const schema::Grid& grid, const ReadState& read_state = {});

// The targets of each of its series.
std::vector<schema::Target> targets_of(const schema::Grid& grid, const ReadState& read_state = {});

}  // namespace haff::campaign
