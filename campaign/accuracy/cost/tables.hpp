// SPDX-License-Identifier: GPL-3.0-or-later

// What accuracy costs, as tables for people, and which runs would tell more.
#pragma once

#include <ostream>
#include <vector>

#include "campaign/accuracy/assessment.hpp"
#include "campaign/accuracy/cost/advice.hpp"
#include "campaign/accuracy/cost/target.hpp"
#include "campaign/results/finished_runs.hpp"
#include "schema/store/reader.hpp"

namespace haff::campaign {

void print_cost_tables(const schema::Reader& store, const std::vector<CostTarget>& targets,
                       const std::vector<FinishedSeries>& finished, const Assessment& assessment,
                       const std::vector<Advice>& advised, std::ostream& report);

}  // namespace haff::campaign
