#include "campaign/precision.hpp"

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
    {over(Measure::a2, 5, 15), 4000, 100, -5e-5, 8e-5},
    {over(Measure::a2, 5, 15), 32000, 24, -4e-5, 4e-5},
    {over(Measure::a2, 40, 60), 4000, 100, 0.0013, 0.0009},
    {over(Measure::a2, 40, 60), 32000, 24, -0.0001, 0.0006},
    {over(Measure::a3, 5, 15), 4000, 100, 3e-5, 7e-5},
    {over(Measure::a3, 5, 15), 32000, 24, 7e-5, 5e-5},
    {over(Measure::gamma_ratio, 8, 12), 4000, 100, -9e-5, 9e-5},
    {over(Measure::gamma_ratio, 8, 12), 32000, 24, 2e-5, 9e-5},
    {over(Measure::gamma_ratio, 48, 52), 4000, 100, 0.001, 0.002},
    {over(Measure::gamma_ratio, 48, 52), 32000, 24, 0.001, 0.001},
    {over(Measure::ln_temperature, 10, 10), 4000, 100, -5.0e-5, 1.9e-5},
    {over(Measure::ln_temperature, 10, 10), 4000, 400, -0.4e-5, 1.3e-5},
    {over(Measure::ln_temperature, 10, 10), 32000, 24, -3.1e-5, 1.2e-5},
    {over(Measure::ln_temperature, 50, 50), 4000, 100, -0.002, 0.003},
    {over(Measure::ln_temperature, 50, 50), 32000, 24, -0.0001, 0.0022},
    {over(Measure::tau_c, 0, 0), 4000, 100, 0.14, 0.19},
    {over(Measure::tau_c, 0, 0), 32000, 24, 0.02, 0.08},
    {correlation_at_5_sigma, 4000, 100, 1.6e-6, 5.6e-6},
    {correlation_at_5_sigma, 32000, 24, 1.4e-6, 5.2e-6},
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
