#include "campaign/accuracy/precision.hpp"

#include <algorithm>

namespace haff::campaign {
namespace {

constexpr Quantity over(Measure measure, double from, double to) {
  return {.measure = measure, .from = from, .to = to};
}

constexpr Quantity correlation_at_5_sigma{
    .measure = Measure::correlation, .from = 50, .to = 50, .r = 5};

// README, What accuracy costs.
constexpr PrecisionShift measured[] = {
    {over(Measure::a2, 5, 15), 4000, 1600, -2.5e-5, 1.9e-5},
    {over(Measure::a2, 5, 15), 32000, 140, -2.1e-5, 2.1e-5},
    {over(Measure::a2, 40, 60), 4000, 1600, 2.2e-4, 2.2e-4},
    {over(Measure::a2, 40, 60), 32000, 140, -0.7e-4, 3.0e-4},
    {over(Measure::a3, 5, 15), 4000, 1600, 5.3e-5, 2.0e-5},
    {over(Measure::a3, 5, 15), 32000, 140, -1.5e-5, 2.1e-5},
    {over(Measure::gamma_ratio, 8, 12), 4000, 1600, -1.0e-5, 2.5e-5},
    {over(Measure::gamma_ratio, 8, 12), 32000, 140, -2.7e-5, 3.3e-5},
    {over(Measure::gamma_ratio, 48, 52), 4000, 1600, 1.8e-4, 5.0e-4},
    {over(Measure::gamma_ratio, 48, 52), 32000, 140, 1.5e-4, 5.7e-4},
    {over(Measure::ln_temperature, 10, 10), 4000, 1600, 1.0e-6, 5.2e-6},
    {over(Measure::ln_temperature, 10, 10), 32000, 140, -2.5e-6, 6.5e-6},
    {over(Measure::ln_temperature, 50, 50), 4000, 1600, -5.0e-4, 7.5e-4},
    {over(Measure::ln_temperature, 50, 50), 32000, 140, -0.3e-4, 9.5e-4},
    {over(Measure::tau_c, 0, 0), 4000, 1600, -0.005, 0.041},
    {over(Measure::tau_c, 0, 0), 32000, 140, -0.005, 0.040},
    {correlation_at_5_sigma, 4000, 1600, -2.4e-7, 8.1e-7},
    {correlation_at_5_sigma, 32000, 140, 5.9e-7, 1.1e-6},
};

}  // namespace

std::vector<PrecisionShift> single_less_double(const Quantity& quantity) {
  std::vector<PrecisionShift> same, similar;
  for (const PrecisionShift& each : measured) {
    if (each.quantity == quantity) same.push_back(each);
    if (each.quantity.measure == quantity.measure) similar.push_back(each);
  }
  return same.empty() ? similar : same;
}

}  // namespace haff::campaign
