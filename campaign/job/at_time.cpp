// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/job/at_time.hpp"

#include <array>

#include "campaign/job/measurement.hpp"

namespace haff::campaign {
namespace {

struct Column {
  const char* curve;
  std::optional<double> schema::Sample::*value;
};

// Columns that hold for a moment. Averages over an interval would need the same interval in all
// realizations.
constexpr std::array of_moments{
    Column{"temperature_at_time", &schema::Sample::temperature},
    Column{"a2_at_time", &schema::Sample::a2},
    Column{"a3_at_time", &schema::Sample::a3},
    Column{"a4_at_time", &schema::Sample::a4},
    Column{"a5_at_time", &schema::Sample::a5},
    Column{"a6_at_time", &schema::Sample::a6},
    Column{"rotational_temperature_at_time", &schema::Sample::rotational_temperature},
    Column{"temperature_1_at_time", &schema::Sample::temperature_1},
    Column{"temperature_2_at_time", &schema::Sample::temperature_2},
};

}  // namespace

std::vector<schema::Profile> measure_at_time(const engine::Simulation& gas, const schema::Job& job,
                                             double time) {
  const double tau = 2 * static_cast<double>(gas.collisions()) / job.particles;
  const schema::Sample now = measure_moment(gas, job, tau);
  std::vector<schema::Profile> points;
  const auto add = [&](const char* curve, double value) {
    points.push_back({.name = curve, .tau = 0, .x = {time}, .value = {value}});
  };
  add("tau_at_time", tau);
  for (const Column& column : of_moments)
    if (const auto& value = now.*column.value) add(column.curve, *value);
  return points;
}

}  // namespace haff::campaign
