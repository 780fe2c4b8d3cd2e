// SPDX-License-Identifier: GPL-3.0-or-later

// The axis of tau: how far each gas is run, and what is to happen on the way. Private to schema/.
#pragma once

#include <string>
#include <vector>

#include "schema/grid/source.hpp"

namespace haff::schema {

// How far each e is run, in the order of e; one number where a grid has no e.
std::vector<double> tau_max_of_each_e(const std::string& file, const Source& source);

// Throws GridError unless each key of a map tau_max is the e of a gas. A map beside "grids" may
// serve several grids.
void must_have_no_strays(const std::string& file, const std::vector<Source>& sources);

// Throws GridError where less than a collision lies between two samples.
void must_collide_between_samples(const std::string& file, const Source& source);

// Throws GridError unless samples, profiles, fields, moments and waiting times lie within the run,
// in numbers that can be counted and stored.
void must_lie_within_run(const std::string& file, const Source& source,
                         const std::vector<double>& tau_max);

}  // namespace haff::schema
