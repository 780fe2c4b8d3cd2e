// SPDX-License-Identifier: GPL-3.0-or-later

// A quantity of a cooling gas: one number from each realization, so that it has an error.
#pragma once

#include <optional>
#include <string>

#include "campaign/results/finished_runs.hpp"

namespace haff::campaign {

enum class Measure { a2, a3, a4, gamma_ratio, ln_temperature, tau_c, correlation };

struct Quantity {
  Measure measure = Measure::a2;
  // The window of tau, both ends included: a2, a3 and a4 are means of its samples, gamma_ratio is
  // ln(T(from) / T(to)) / (2 gamma_0 (to - from)). The others belong to `to`, tau_c to none.
  double from = 0, to = 0;
  double r = 0;  // of correlation: G_parallel at this distance [sigma]

  bool operator==(const Quantity&) const = default;
};

// Over a usual window: of the plateau of a2, a3 and a4, which needs no tau; of 2 to either side of
// tau for gamma_ratio; at tau for the others, G_parallel at 5 sigma. tau_c needs none.
Quantity usual_quantity(Measure measure, double tau = 0);
// In a window, "3:8", or at one tau, "20", of which gamma_ratio takes 2 to either side. Nothing if
// the measure cannot have it, or the text is neither.
std::optional<Quantity> quantity_at(Measure measure, const std::string& window);
Quantity quantity_of(const schema::Target& target);
bool is_laguerre(Measure measure);  // a2, a3, a4

std::string name(Measure measure);  // a word for tables: "ln_temperature"
std::optional<Measure> measure_named(const std::string& name);
std::string describe(const Quantity& quantity);  // "a2, tau 5 to 15"
Quantity middle_half(const Quantity& quantity);  // of its window

// Its value in one realization, from every k-th sample only; nothing if the run did not reach or
// measure it.
std::optional<double> value_of(const Quantity& quantity, const schema::Job& job,
                               const FinishedRun& run, std::size_t every = 1);

// The error of that value from this realization alone. A window of some correlation times cannot
// tell its own error: blocks over all the run from the window on tell the correlation time t, and
//   error^2 = 2 s^2 t / W [1 - (1 - exp(-W/t)) t/W],   W the window, s the samples' deviation,
// that of correlations which fall exponentially, is the window's. A drift after the window makes it
// larger. Nothing where blocks make no sense, or the run is too short for eight of them, each of
// eight correlation times: of a2 in tau some 120.
struct OneRunError {
  double standard_error = 0;
  double correlation_time = 0;  // [tau]
};
std::optional<OneRunError> error_within(const Quantity& quantity, const schema::Job& job,
                                        const FinishedRun& run);

// Half the 95 % interval of the mean of a series that was run until a target was met: the scatter
// of the target's pilot runs alone decides (analysis/statistics/accuracy.hpp says why). Nothing
// until each of them has a value.
std::optional<double> half_interval(const schema::Target& target, const FinishedSeries& series);

// CPU time of one realization run as far as the quantity needs, its equilibration included and
// cooling in proportion to tau. [s]
double cpu_seconds(const Quantity& quantity, const FinishedRun& run);

// Of the realizations that have one.
std::vector<double> values_of(const Quantity& quantity, const FinishedSeries& series);

// The number of runs that ended before their tau_c. The others are the early ones, whose mean is
// not the tau_c of the gas.
std::size_t unfinished(const Quantity& quantity, const FinishedSeries& series);

}  // namespace haff::campaign
