// From a job to the model the engine runs.
#pragma once

#include "engine/simulation.hpp"
#include "schema/job.hpp"

namespace haff::campaign {

engine::Model model_of(const schema::Job& job);

}  // namespace haff::campaign
