// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/curves/theory_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "analysis/theory/collision_statistics.hpp"
#include "analysis/theory/cooling.hpp"
#include "analysis/theory/enskog.hpp"
#include "analysis/theory/enskog_boltzmann.hpp"
#include "analysis/theory/self_diffusion.hpp"
#include "analysis/theory/spectrum.hpp"
#include "campaign/curves/theory_curves.hpp"
#include "campaign/curves/theory_point.hpp"

namespace haff::campaign {
namespace {

// A direct simulation computed for a picture: half a per cent of a2's own errors, in seconds.
constexpr analysis::SimulationSize quick{.particles = 50'000, .realizations = 4, .seed = 1};

struct Kind {
  std::string_view ending;  // of a column of `campaign theory`
  std::string_view legend;
  Look look;
};
constexpr std::array kinds{
    Kind{"_energy_equation_non_gaussian", "energy equation", Look::line},
    Kind{"_energy_equation", "energy equation, Gaussian velocities", Look::dash_dotted},
    Kind{"_haff", "Haff's law", Look::dotted},
    Kind{"_second_order", "Enskog–Boltzmann, first order in {/:Italic a}_2", Look::dashed},
    Kind{"_dsmc", "Enskog–Boltzmann, direct simulation", Look::dotted},
    Kind{"_incompressible", "incompressible theory", Look::line},
    Kind{"_compressible", "compressible theory", Look::dashed},
    Kind{"_enskog", "Enskog's theory", Look::line},
    Kind{"_gaussian", "theory for Gaussian velocities", Look::dashed},
    Kind{"", "theory", Look::line},
};

TheoryLine line_named(const std::string& name) {
  const auto kind = std::ranges::find_if(
      kinds, [&](const Kind& each) { return std::string_view(name).ends_with(each.ending); });
  return {.name = name, .legend = std::string(kind->legend), .look = kind->look};
}

TheoryPoint point_of(const schema::Job& job) {
  TheoryPoint at = theory_point(job);
  at.size = quick;
  at.may_compute = at.other_law;
  return at;
}

// The values of a theory; nothing where it does not hold.
std::vector<TheoryLine> lines_of(std::string_view curve_name, const TheoryPoint& at,
                                 std::span<const double> values) try {
  const TheoryCurve* curve = theory_curve(curve_name);
  if (curve == nullptr || !knows(*curve, at) || values.empty()) return {};
  const TheoryTable table = curve->compute(at, values);
  std::vector<TheoryLine> lines;
  for (std::size_t c = 1; c < table.columns.size(); ++c) {
    std::vector<double> column;
    for (const auto& row : table.rows) column.push_back(row[c]);
    if (table.columns[c].ends_with("_se")) {
      lines.back().errors = std::move(column);
      continue;
    }
    lines.push_back(line_named(table.columns[c]));
    lines.back().values = std::move(column);
  }
  return lines;
} catch (const std::invalid_argument&) {  // an elastic gas, for instance
  return {};
} catch (const std::domain_error&) {
  return {};
}

using Change = std::function<double(double)>;

std::vector<TheoryLine> changed(std::vector<TheoryLine> lines, const std::string& name,
                                const Change& change) {
  for (TheoryLine& line : lines) {
    const auto ending = line.name.find('_');
    line.name = name + (ending == std::string::npos ? "" : line.name.substr(ending));
    std::ranges::transform(line.values, line.values.begin(), change);
    line.errors.clear();
  }
  return lines;
}

TheoryLine constant(const std::string& name, double value, std::size_t count) {
  TheoryLine line = line_named(name);
  line.values.assign(count, value);
  return line;
}

std::optional<double> compressibility(const TheoryPoint& at) {
  const auto lines = lines_of("Z", at, std::array{at.n});
  if (lines.empty()) return std::nullopt;
  return lines.front().values.front();
}

// One value of several: their mean, without an error.
std::vector<TheoryLine> averaged(std::vector<TheoryLine> lines) {
  for (TheoryLine& line : lines) {
    double sum = 0;
    for (const double each : line.values) sum += each;
    line.values = {sum / static_cast<double>(line.values.size())};
    line.errors.clear();
  }
  return lines;
}

std::vector<double> steps(double from, double to) {
  constexpr int count = 40;
  if (from == to) return {from};
  std::vector<double> tau;
  for (int i = 0; i <= count; ++i) tau.push_back(from + (to - from) * i / count);
  return tau;
}

bool is_heated(const TheoryPoint& at) {
  return at.gas.heating > 0;
}

// Enskog's theory of an elastic gas: the contact value, at which g begins, self-diffusion, and the
// decay of velocity correlations. For gases that cool slowly it is a first approximation.
std::vector<TheoryLine> lines_of_elastic_gas(const std::string& profile, const TheoryPoint& at,
                                             std::span<const double> x) {
  if (at.roughness || at.mixture) return {};
  TheoryLine line = line_named(profile + "_enskog");
  line.legend = "Enskog's theory, elastic gas";
  if (profile == "g") {
    line.legend = "contact value, equation of state";
    line.look = Look::dashed;
  }
  for (const double each : x)
    line.values.push_back(profile == "g" ? analysis::contact_value(at.n, at.d)
                          : profile == "diffusion"
                              ? analysis::self_diffusion_per_collision(at.n, at.d)
                              : analysis::enskog_autocorrelation(each, at.d));
  constexpr double densest_simulated = 1.08;
  if (profile != "diffusion" || at.d == 2 || at.n > densest_simulated) return {line};
  TheoryLine simulated = constant(profile + "_simulated",
                                  analysis::simulated_self_diffusion_per_collision(at.n), x.size());
  simulated.legend = "molecular dynamics, elastic gas";
  simulated.look = Look::dashed;
  return {line, simulated};
}

// Collisions of an elastic gas in molecular chaos, a first approximation for a gas that cools. Only
// impact parameters do not depend on masses and temperatures of species.
std::vector<TheoryLine> lines_of_collisions(const std::string& profile, const TheoryPoint& at,
                                            std::span<const double> x) {
  TheoryLine line = line_named(profile + "_chaos");
  line.legend = "molecular chaos";
  line.look = Look::dashed;
  if (profile != "impacts") {
    if (at.mixture) return {};
    line.legend = "molecular chaos, elastic gas";
  }
  for (const double each : x)
    line.values.push_back(profile == "impacts"      ? 1
                          : profile == "free_times" ? analysis::free_time_density(each, at.d)
                                                    : analysis::normal_speed_density(each));
  return {line};
}

// Equipartition, and the fluctuating hydrodynamics of the cooling gas (energy_spectrum.hpp).
std::vector<TheoryLine> spectrum(const std::string& profile, const TheoryPoint& at,
                                 std::span<const double> k) {
  if (at.roughness || at.other_law || at.is_shuffled || is_heated(at)) return {};
  const bool is_parallel = profile == "E_parallel";
  TheoryLine equal = line_named(profile + "_equipartition"), hydrodynamic = line_named(profile);
  equal.legend = "equipartition at Haff's temperature";
  equal.look = Look::dashed;
  hydrodynamic.legend = "fluctuating hydrodynamics";
  const double temperature = analysis::haff_temperature(at.tau, at.e, at.d);
  for (const double each : k) {
    equal.values.push_back(
        analysis::equilibrium_spectrum(each, at.n, temperature, is_parallel, at.d));
    if (at.e < 1)
      hydrodynamic.values.push_back(
          equal.values.back() *
          analysis::spectrum_ratio({.e = at.e, .n = at.n, .d = at.d}, each, at.tau, is_parallel));
  }
  if (at.mixture || !(at.e < 1)) return {equal};
  return {equal, hydrodynamic};
}

// The stationary state of a gas with a thermostat and a constant e.
void add_heated_a2(const TheoryPoint& at, std::size_t count, std::vector<TheoryLine>& lines) {
  if (!is_heated(at) || !std::holds_alternative<analysis::ConstantRestitution>(at.gas.law)) return;
  if (at.roughness || at.mixture) return;
  lines.push_back(constant("a2_heated_second_order", analysis::heated_a2(at.e, at.d), count));
  lines.back().legend = "heated gas at rest, first order in {/:Italic a}_2";
}

std::vector<TheoryLine> decay_rates(const Quantity& quantity, const schema::Job& job) {
  std::vector<TheoryLine> lines;
  const std::array ends{quantity.from, quantity.to};
  for (TheoryLine& line : theory_in_tau("temperature", job, ends)) {
    if (line.name.ends_with("_haff") || line.values.size() < 2) continue;
    line.values = {analysis::gamma_ratio(line.values[0], line.values[1],
                                         quantity.to - quantity.from, *job.e, job.d)};
    line.name.replace(0, std::string_view("temperature").size(), "gamma_ratio");
    lines.push_back(std::move(line));
  }
  for (TheoryLine& line : theory_of_mean("gamma_ratio", job, quantity.from, quantity.to))
    if (line.name.ends_with("_second_order") || line.name.ends_with("_dsmc"))
      lines.push_back(std::move(line));
  return lines;
}

}  // namespace

std::vector<TheoryLine> theory_in_tau(const std::string& column, const schema::Job& job,
                                      std::span<const double> tau, Simulations simulations) try {
  TheoryPoint at = point_of(job);
  if (simulations == Simulations::left_out) at.may_compute = false;
  if (column == "energy")
    return changed(lines_of("temperature", at, tau), column,
                   [&](double t) { return t * at.d / 2; });
  if (column == "Z") {
    const auto z = compressibility(at);
    return z ? std::vector{constant("Z_enskog", *z, tau.size())} : std::vector<TheoryLine>{};
  }
  if (column == "pressure") {
    const auto z = compressibility(at);
    if (!z) return {};
    return changed(lines_of("temperature", at, tau), column,
                   [&](double t) { return at.n * t * *z; });
  }
  if (column == "collision_rate") {
    if (at.other_law || at.roughness || at.mixture) return {};
    return changed(lines_of("temperature", at, tau), column,
                   [&](double t) { return analysis::transport(at.n, t, at.d).collision_rate; });
  }
  auto lines = lines_of(column, at, tau);
  if (column == "a2") add_heated_a2(at, tau.size(), lines);
  return lines;
} catch (const TheoryError&) {
  return {};
}

std::vector<double> times_of(const TheoryLine& line, const schema::Job& job,
                             std::span<const double> tau, Simulations simulations) {
  const bool is_haff = line.name.ends_with("_haff") || line.name.ends_with("_second_order") ||
                       line.name.ends_with("_dsmc");
  const std::string clock =
      is_haff ? "temperature_haff" : "temperature_energy_equation_non_gaussian";
  const auto temperatures = theory_in_tau("temperature", job, tau, simulations);
  const auto found = std::ranges::find(temperatures, clock, &TheoryLine::name);
  if (found == temperatures.end()) return {};
  // dt = dtau / omega, and 1/omega grows exponentially: its mean over a step is the geometric one.
  std::vector<double> time{0};
  double before = 0;
  for (std::size_t i = 0; i < tau.size(); ++i) {
    const double rate = analysis::transport(job.n, found->values[i], job.d).collision_rate;
    if (i > 0) time.push_back(time.back() + (tau[i] - tau[i - 1]) / std::sqrt(rate * before));
    before = rate;
  }
  return time;
}

std::vector<TheoryLine> theory_of_profile(const std::string& profile, const schema::Job& job,
                                          double tau, std::span<const double> x) try {
  if (profile == "rho") {
    TheoryLine gaussian = line_named("rho_maxwell");
    gaussian.legend = "exp(−{/:Italic c}^2)";
    gaussian.look = Look::dashed;
    for (const double c : x) gaussian.values.push_back(std::exp(-c * c));
    return {gaussian};
  }
  TheoryPoint at = point_of(job);
  at.tau = tau;
  if (profile == "g" || profile == "diffusion" || profile == "vacf")
    return lines_of_elastic_gas(profile, at, x);
  if (profile == "free_times" || profile == "impacts" || profile == "normal_speeds")
    return lines_of_collisions(profile, at, x);
  if (profile == "E_perpendicular" || profile == "E_parallel") return spectrum(profile, at, x);
  if (!(tau > 0)) return {};
  return lines_of(profile, at, x);
} catch (const TheoryError&) {
  return {};
}

std::vector<TheoryLine> theory_of_mean(const std::string& column, const schema::Job& job,
                                       double from, double to) {
  return averaged(theory_in_tau(column, job, steps(from, to)));
}

std::vector<TheoryLine> theory_of_quantity(const Quantity& quantity, const schema::Job& job) try {
  switch (quantity.measure) {
    case Measure::tau_c:
      return lines_of("tau_c", point_of(job), std::array{job.e.value_or(1)});
    case Measure::gamma_ratio:
      return decay_rates(quantity, job);
    case Measure::ln_temperature:
      return changed(theory_in_tau("temperature", job, std::array{quantity.to}), "ln_temperature",
                     [&](double t) { return std::log(t / analysis::initial_temperature(job.d)); });
    case Measure::correlation:
      return theory_of_profile("G_parallel", job, quantity.to, std::array{quantity.r});
    default:
      return theory_of_mean(name(quantity.measure), job, quantity.from, quantity.to);
  }
} catch (const TheoryError&) {
  return {};
}

}  // namespace haff::campaign
