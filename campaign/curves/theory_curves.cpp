// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/curves/theory_curves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "analysis/direct/table.hpp"
#include "analysis/theory/cooling.hpp"
#include "analysis/theory/correlations.hpp"
#include "analysis/theory/energy_equation.hpp"
#include "analysis/theory/enskog.hpp"
#include "analysis/theory/enskog_boltzmann.hpp"
#include "analysis/theory/modes.hpp"

namespace haff::campaign {
namespace {

using analysis::Fluid;
using analysis::Velocities;
using Values = std::span<const double>;
using Row = std::vector<double>;

analysis::Gas gas_of(const TheoryPoint& at) {
  return {.e = at.e, .n = at.n, .d = at.d};
}

TheoryTable table(std::vector<std::string> columns, Values values,
                  const std::function<Row(double)>& of) {
  TheoryTable result{.columns = std::move(columns), .rows = {}};
  for (const double value : values) {
    Row row = of(value);
    row.insert(row.begin(), value);
    result.rows.push_back(std::move(row));
  }
  return result;
}

// One quantity of the direct simulation with its error at each tau: from the table where the table
// has this gas, otherwise computed.
std::vector<analysis::TabulatedValue> direct(
    const TheoryPoint& at, Values tau, std::string_view tabulated_name,
    const std::function<analysis::Estimate(const analysis::DirectPoint&)>& of) {
  std::vector<analysis::TabulatedValue> result;
  if (!at.other_law && !tabulated_name.empty()) {
    if (const auto curve = analysis::tabulated(tabulated_name, at.e, at.d)) {
      for (const double each : tau) result.push_back(curve->at(each));
      return result;
    }
  }
  if (!at.may_compute) return result;
  for (const auto& point :
       analysis::direct_means(analysis::direct_realizations(at.gas, tau, at.size))) {
    const analysis::Estimate value = of(point);
    result.push_back({.value = value.mean, .error = value.standard_error});
  }
  return result;
}

// The columns of a tau curve: theories in closed form first, then the direct simulation.
struct Column {
  std::string name;
  std::vector<double> values;
};

TheoryTable against_tau(Values tau, const std::vector<Column>& theories, const std::string& name,
                        const std::vector<analysis::TabulatedValue>& simulated) {
  TheoryTable result{.columns = {"tau"}, .rows = {}};
  for (const Column& each : theories) result.columns.push_back(each.name);
  if (!simulated.empty()) {
    result.columns.push_back(name + "_dsmc");
    result.columns.push_back(name + "_dsmc_se");
  }
  for (std::size_t k = 0; k < tau.size(); ++k) {
    Row row{tau[k]};
    for (const Column& each : theories) row.push_back(each.values[k]);
    if (!simulated.empty()) {
      row.push_back(simulated[k].value);
      row.push_back(simulated[k].error);
    }
    result.rows.push_back(std::move(row));
  }
  return result;
}

std::vector<double> map(Values tau, const std::function<double(double)>& of) {
  std::vector<double> result;
  for (const double each : tau) result.push_back(of(each));
  return result;
}

std::vector<double> equation(const TheoryPoint& at, Values tau, Velocities velocities,
                             double (*of)(const analysis::EnergyPoint&)) {
  std::vector<double> result;
  for (const auto& point : analysis::energy_equation(gas_of(at), tau, at.b, velocities))
    result.push_back(of(point));
  return result;
}

template <int l>
TheoryTable laguerre(const TheoryPoint& at, Values tau) {
  const std::string name = "a" + std::to_string(l);
  std::vector<Column> theories;
  if (l == 2 && !at.other_law)
    theories.push_back({"a2_second_order", map(tau, [&](double each) {
                          return analysis::boltzmann_a2(each, at.e, at.d);
                        })});
  return against_tau(tau, theories, name,
                     direct(at, tau, name, [](const analysis::DirectPoint& point) {
                       return point.laguerre[static_cast<std::size_t>(l)];
                     }));
}

TheoryTable gamma_ratio(const TheoryPoint& at, Values tau) {
  std::vector<Column> theories;
  if (!at.other_law) {
    const auto of = [](const analysis::EnergyPoint& point) { return point.gamma_ratio; };
    theories = {{"gamma_ratio_second_order", map(tau,
                                                 [&](double each) {
                                                   return analysis::boltzmann_gamma_ratio(
                                                       analysis::boltzmann_a2(each, at.e, at.d));
                                                 })},
                {"gamma_ratio_energy_equation", equation(at, tau, Velocities::gaussian, of)},
                {"gamma_ratio_energy_equation_non_gaussian",
                 equation(at, tau, Velocities::enskog_boltzmann, of)}};
    if (at.is_shuffled) theories.resize(1);
  }
  return against_tau(tau, theories, "gamma_ratio",
                     direct(at, tau, "gamma_ratio",
                            [](const analysis::DirectPoint& point) { return point.gamma_ratio; }));
}

TheoryTable rate_ratio(const TheoryPoint& at, Values tau) {
  std::vector<Column> theories;
  if (!at.other_law)
    theories.push_back({"rate_ratio_second_order", map(tau, [&](double each) {
                          return analysis::boltzmann_rate_ratio(
                              analysis::boltzmann_a2(each, at.e, at.d));
                        })});
  return against_tau(tau, theories, "rate_ratio",
                     direct(at, tau, "rate_ratio",
                            [](const analysis::DirectPoint& point) { return point.rate_ratio; }));
}

// Temperatures of rough particles that start without rotation, with Gaussian velocities and spins.
std::vector<double> rough(const TheoryPoint& at, Values tau,
                          double (*of)(const analysis::RoughTemperatures&)) {
  const analysis::RoughTemperatures start{.translation = analysis::initial_temperature(at.d)};
  return map(tau, [&](double each) {
    return of(analysis::rough_temperatures(each, at.e, *at.roughness, start));
  });
}

TheoryTable rotational_temperature(const TheoryPoint& at, Values tau) {
  return against_tau(tau,
                     {{"rotational_temperature_gaussian",
                       rough(at, tau, [](const auto& both) { return both.rotation; })}},
                     "", {});
}

TheoryTable rotational_ratio(const TheoryPoint& at, Values tau) {
  return against_tau(
      tau,
      {{"rotational_ratio_gaussian",
        rough(at, tau, [](const auto& both) { return both.rotation / both.translation; })}},
      "", {});
}

TheoryTable species_ratio(const TheoryPoint& at, Values tau) {
  const double ratio = at.gas.heating > 0 ? analysis::heated_temperature_ratio(*at.mixture)
                                          : analysis::temperature_ratio(*at.mixture);
  return against_tau(tau, {{"species_ratio_gaussian", std::vector<double>(tau.size(), ratio)}}, "",
                     {});
}

// p = n T (1 + 2^(d-2) (1 + e) phi chi): V. Garzo and J. W. Dufty, Phys. Rev. E 59, 5895 (1999).
TheoryTable compressibility(const TheoryPoint& at, Values n) {
  return table({"n", "Z_enskog"}, n, [&](double each) -> Row {
    return {1 + (1 + at.e) / 2 * (analysis::equation_of_state(each, at.d).z - 1)};
  });
}

TheoryTable temperature(const TheoryPoint& at, Values tau) {
  if (at.roughness)
    return against_tau(tau,
                       {{"temperature_gaussian",
                         rough(at, tau, [](const auto& both) { return both.translation; })}},
                       "", {});
  if (at.other_law)
    return against_tau(
        tau, {}, "temperature",
        direct(at, tau, "", [](const analysis::DirectPoint& point) { return point.temperature; }));
  const double start = analysis::initial_temperature(at.d);
  const auto scaled = [&](Velocities velocities) {
    auto values =
        equation(at, tau, velocities, [](const analysis::EnergyPoint& p) { return p.energy; });
    for (double& each : values) each *= start;
    return values;
  };
  std::vector<Column> theories{{"temperature_haff", map(tau, [&](double each) {
                                  return analysis::haff_temperature(each, at.e, at.d);
                                })}};
  if (!at.is_shuffled) {
    theories.push_back({"temperature_energy_equation", scaled(Velocities::gaussian)});
    theories.push_back(
        {"temperature_energy_equation_non_gaussian", scaled(Velocities::enskog_boltzmann)});
  }
  return against_tau(tau, theories, "", {});
}

TheoryTable tau_c(const TheoryPoint& at, Values e) {
  return table({"e", "tau_c_energy_equation", "tau_c_energy_equation_non_gaussian"}, e,
               [&](double each) -> Row {
                 const analysis::Gas gas{.e = each, .n = at.n, .d = at.d};
                 return {analysis::energy_equation_tau_c(gas, at.b),
                         analysis::energy_equation_tau_c(gas, at.b, Velocities::enskog_boltzmann)};
               });
}

TheoryTable plateau(const TheoryPoint& at, Values e) {
  return table({"e", "a2_second_order", "a2_dsmc", "a2_dsmc_se", "a3_dsmc", "a3_dsmc_se", "a4_dsmc",
                "a4_dsmc_se", "gamma_ratio_dsmc", "gamma_ratio_dsmc_se"},
               e, [&](double each) {
                 Row row{analysis::boltzmann_a2_plateau(each, at.d)};
                 for (const char* name : {"a2", "a3", "a4", "gamma_ratio"}) {
                   constexpr double none = std::numeric_limits<double>::quiet_NaN();
                   const auto curve = analysis::tabulated(name, each, at.d);
                   row.push_back(curve ? curve->plateau.value : none);
                   row.push_back(curve ? curve->plateau.error : none);
                 }
                 return row;
               });
}

template <bool parallel>
TheoryTable correlation(const TheoryPoint& at, Values r) {
  const std::string name = parallel ? "G_parallel" : "G_perpendicular";
  return table({"r", name + "_incompressible", name + "_compressible"}, r, [&](double each) -> Row {
    const auto of = [&](Fluid fluid) {
      const auto both = analysis::velocity_correlation(gas_of(at), each, at.tau, fluid);
      return parallel ? both.parallel : both.perpendicular;
    };
    return {of(Fluid::incompressible), of(Fluid::compressible)};
  });
}

TheoryTable correlation_trace(const TheoryPoint& at, Values tau) {
  return table({"tau", "correlation_trace"}, tau, [&](double each) -> Row {
    return {analysis::correlation_trace(gas_of(at), each, at.b)};
  });
}

TheoryTable growth_rates(const TheoryPoint& at, Values k) {
  return table({"k", "shear", "longitudinal_1", "longitudinal_1_imaginary", "longitudinal_2",
                "longitudinal_2_imaginary", "longitudinal_3", "longitudinal_3_imaginary"},
               k, [&](double each) {
                 const auto spectrum = analysis::modes(gas_of(at), each);
                 Row row{spectrum.transverse};
                 for (const auto& mode : spectrum.longitudinal) {
                   row.push_back(mode.real());
                   row.push_back(mode.imag());
                 }
                 return row;
               });
}

TheoryTable lengths(const TheoryPoint& at, Values e) {
  return table({"e", "free_path", "xi_transverse", "xi_sound", "xi_heat", "xi_longitudinal",
                "critical_box", "critical_N"},
               e, [&](double each) -> Row {
                 const auto length = analysis::lengths({.e = each, .n = at.n, .d = at.d});
                 const double box = 2 * std::numbers::pi * length.transverse;
                 return {length.free_path,
                         length.transverse,
                         length.sound,
                         length.heat,
                         length.longitudinal,
                         box,
                         at.n * std::pow(box, at.d)};
               });
}

TheoryTable elastic_fluid(const TheoryPoint& at, Values n) {
  return table({"n", "chi", "Z", "collision_rate", "viscosity", "bulk_viscosity", "conductivity"},
               n, [&](double each) -> Row {
                 const auto at_unit = analysis::transport(each, 1, at.d);
                 return {analysis::contact_value(each, at.d),
                         analysis::equation_of_state(each, at.d).z,
                         at_unit.collision_rate,
                         at_unit.viscosity,
                         at_unit.bulk_viscosity,
                         at_unit.conductivity};
               });
}

TheoryTable heated_a2(const TheoryPoint& at, Values e) {
  return table({"e", "heated_a2_second_order"}, e,
               [&](double each) -> Row { return {analysis::heated_a2(each, at.d)}; });
}

constexpr std::array curves{
    TheoryCurve{"a2", "tau", "Laguerre coefficient a_2 without correlations (Enskog-Boltzmann)",
                Treats::any_law, laguerre<2>},
    TheoryCurve{"a3", "tau", "a_3, likewise: direct simulation (dsmc) alone", Treats::any_law,
                laguerre<3>},
    TheoryCurve{"a4", "tau", "a_4, likewise", Treats::any_law, laguerre<4>},
    TheoryCurve{"a5", "tau", "a_5, likewise", Treats::any_law, laguerre<5>},
    TheoryCurve{"a6", "tau", "a_6, likewise", Treats::any_law, laguerre<6>},
    TheoryCurve{"gamma_ratio", "tau",
                "decay rate gamma/gamma_0: without correlations, and by the energy equation",
                Treats::any_law, gamma_ratio},
    TheoryCurve{"rate_ratio", "tau", "collision rate omega/omega_0 at the gas's own temperature",
                Treats::any_law, rate_ratio},
    TheoryCurve{"temperature", "tau", "T [E(0)]: Haff's law and the energy equation",
                Treats::any_law_or_rough, temperature},
    TheoryCurve{"correlation_trace", "tau", "Tr G+(0) [E(0)/m], cut off at k_M", Treats::correlated,
                correlation_trace},
    TheoryCurve{"G_parallel", "r", "longitudinal velocity correlation at --tau [E(0)/m]",
                Treats::correlated, correlation<true>},
    TheoryCurve{"G_perpendicular", "r", "transverse velocity correlation at --tau [E(0)/m]",
                Treats::correlated, correlation<false>},
    TheoryCurve{"growth_rates", "k", "linear modes of the cooling gas [1/tau]", Treats::correlated,
                growth_rates},
    TheoryCurve{"tau_c", "e", "end of the homogeneous stage, by the energy equation",
                Treats::correlated, tau_c},
    TheoryCurve{"plateau", "e", "a_2, a_3, a_4 and gamma/gamma_0 that no longer change",
                Treats::smooth, plateau},
    TheoryCurve{"heated_a2", "e", "a_2 of the gas heated by white noise, first order in a_2",
                Treats::smooth, heated_a2},
    TheoryCurve{"lengths", "e", "correlation lengths [sigma], smallest box with vortices and its N",
                Treats::correlated, lengths},
    TheoryCurve{"elastic_fluid", "n",
                "chi of Carnahan and Starling (disks: Henderson), Z, and Enskog's rates at T = 1",
                Treats::smooth, elastic_fluid},
    TheoryCurve{"rotational_temperature", "tau",
                "temperature of rotation of rough particles [E(0)]", Treats::rough,
                rotational_temperature},
    TheoryCurve{"rotational_ratio", "tau", "temperature of rotation over that of translation",
                Treats::rough, rotational_ratio},
    TheoryCurve{"species_ratio", "tau",
                "T_1/T_2 of a mixture that cools homogeneously, or is heated and at rest",
                Treats::mixture, species_ratio},
    TheoryCurve{"Z", "n", "pressure / (n T) of the gas that collides with e", Treats::smooth,
                compressibility},
};

}  // namespace

std::span<const TheoryCurve> theory_curves() {
  return curves;
}

const TheoryCurve* theory_curve(std::string_view name) {
  const auto found = std::ranges::find(curves, name, &TheoryCurve::name);
  return found == curves.end() ? nullptr : &*found;
}

}  // namespace haff::campaign
