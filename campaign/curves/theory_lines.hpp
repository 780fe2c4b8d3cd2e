// SPDX-License-Identifier: GPL-3.0-or-later

// The theory beside what is drawn of a gas: the curves of `campaign theory`, brought to the points
// and the units of a plot.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "campaign/accuracy/quantity.hpp"
#include "campaign/plot/plot.hpp"
#include "schema/grid/job.hpp"

namespace haff::campaign {

struct TheoryLine {
  std::string name;    // "a2_second_order", for tables
  std::string legend;  // enhanced text
  Look look = Look::line;
  std::vector<double> values = {};
  std::vector<double> errors = {};  // empty where the theory has none
};

// Each function gives a value for each place, and no line where there is no theory of this gas. A
// direct simulation that is not in the table is computed where the law of restitution is not a
// constant e, and is left out otherwise.
enum class Simulations { computed, left_out };

// A column of samples, at increasing tau.
std::vector<TheoryLine> theory_in_tau(const std::string& column, const schema::Job& job,
                                      std::span<const double> tau,
                                      Simulations simulations = Simulations::computed);

// The times of these tau on such a line [sigma sqrt(m/E(0))]: Haff's law for theories without
// correlations, else the energy equation. Nothing for gases that neither is of.
std::vector<double> times_of(const TheoryLine& line, const schema::Job& job,
                             std::span<const double> tau,
                             Simulations simulations = Simulations::computed);

// A profile at its x.
std::vector<TheoryLine> theory_of_profile(const std::string& profile, const schema::Job& job,
                                          double tau, std::span<const double> x);

// One value each: a quantity, or the mean of a column over a window of tau.
std::vector<TheoryLine> theory_of_quantity(const Quantity& quantity, const schema::Job& job);
std::vector<TheoryLine> theory_of_mean(const std::string& column, const schema::Job& job,
                                       double from, double to);

}  // namespace haff::campaign
