// SPDX-License-Identifier: GPL-3.0-or-later

// The lines of theory beside the gases of a picture.
#pragma once

#include <string>
#include <vector>

#include "campaign/curves/gas_curves.hpp"
#include "campaign/curves/question.hpp"
#include "campaign/plot/plot.hpp"

namespace haff::campaign {

// Adds the lines of all gases, which are the panel's curves so far, and entries of the legend; a
// line that several gases share, such as Haff's law of several densities, is drawn once and in
// grey.
void add_theory(const Topic& topic, const std::vector<GasCurve>& gases, Panel& panel,
                std::vector<std::string>& notes);

// A sentence about the contact value that lines of the panel take; empty if none does.
std::string contact_value_note(const Panel& panel);

}  // namespace haff::campaign
