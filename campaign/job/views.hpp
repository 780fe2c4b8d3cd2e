// SPDX-License-Identifier: GPL-3.0-or-later

// What is measured of the whole gas beside a sample: curves, and the gas in cells.
//
// An observable that is taken with profiles is one line in the table of views.cpp, from its name to
// the function that measures it.
#pragma once

#include <vector>

#include "engine/simulation.hpp"
#include "schema/grid/job.hpp"
#include "schema/rows/measured.hpp"

namespace haff::campaign {

struct Views {
  std::vector<schema::Profile> profiles;
  std::vector<schema::Field> fields;
};

// The profiles and fields that the job takes with this sample, none at most tau. Fills those
// columns of the sample that are taken with profiles.
Views view(const engine::Simulation& gas, const schema::Job& job, schema::Sample& sample);

}  // namespace haff::campaign
