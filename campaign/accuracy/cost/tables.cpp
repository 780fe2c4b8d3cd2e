// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/accuracy/cost/tables.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "campaign/accuracy/differences.hpp"
#include "campaign/base/text/duration.hpp"
#include "campaign/base/text/job_text.hpp"
#include "campaign/base/text/number_text.hpp"
#include "campaign/base/text/printable.hpp"
#include "campaign/base/text/text_table.hpp"

namespace haff::campaign {

namespace {

std::string plan_for(SystematicEffect cause) {
  switch (cause) {
    case SystematicEffect::finite_size:
      return R"(plan the same grid with several "N", e.g. "N": [2000, 8000, 32000])";
    case SystematicEffect::equilibration:
      return R"(plan the same grid with "equilibrate": [50, 100])";
    case SystematicEffect::sampling:
      return "needs two realizations that both reach it, with frequent samples";
    case SystematicEffect::averaging:
      return "needs two realizations";
    case SystematicEffect::mesh:
      return R"(needs two realizations with "correlations" in a box of more than 16 sigma)";
  }
  return "";
}

std::string gas_text(const schema::Job& job) {
  return fmt::format("e {}, n {}{}{}", e_text(job), number_text(job.n), job.d == 2 ? ", disks" : "",
                     job.effects.none() ? "" : ", " + printable(job.effects.text()));
}

// Names in the order of their first appearance.
void add_once(std::vector<std::string>& names, const std::string& name) {
  if (std::ranges::find(names, name) == names.end()) names.push_back(name);
}

std::string joined(const std::vector<std::string>& parts) {
  return fmt::format("{}", fmt::join(parts, "; "));
}

// An error to two digits.
std::string error_text(double error) {
  return std::isfinite(error) ? fmt::format("{:.1e}", error) : no_value;
}

void print_statistics(const Assessment& assessment, std::ostream& report) {
  TextTable table({{"quantity", Align::left},
                   {"e"},
                   {"n"},
                   {"N"},
                   {"runs"},
                   {"mean"},
                   {"error"},
                   {"95 % interval"},
                   {"CPU s/run"},
                   {"error x CPU^1/2"},
                   {"slope"},
                   {"", Align::left}});
  for (const Statistics& each : assessment.statistics) {
    std::vector<std::string> notes;
    if (each.correlation_time)
      notes.push_back(
          fmt::format("blocks over tau, correlation time {:.2g}", *each.correlation_time));
    else if (each.realizations == 1)
      notes.emplace_back("one run: no error");
    if (each.unfinished > 0)
      notes.push_back(fmt::format("too early: {} runs ended before", each.unfinished));
    if (each.interval_runs < each.realizations)
      notes.push_back(fmt::format("interval from {} pilot runs", each.interval_runs));
    if (each.job.equilibrate != schema::Job{}.equilibrate)
      notes.push_back(fmt::format("equilibrate {:g}", each.job.equilibrate));
    if (!each.job.effects.none()) notes.push_back(each.job.effects.text());
    table.add({describe(each.quantity), e_text(each.job), number_text(each.job.n),
               count_text(each.job.particles),
               count_text(static_cast<long long>(each.realizations)),
               value_text(each.mean, each.error), error_text(each.error),
               std::isfinite(each.half_interval) ? "± " + error_text(each.half_interval) : no_value,
               fmt::format("{:.3g}", each.cpu_seconds),
               error_text(each.deviation * std::sqrt(each.cpu_seconds)),
               each.slope ? fmt::format("{:.2f} ± {:.2f}", each.slope->value, each.slope->error)
                          : no_value,
               joined(notes)});
  }
  fmt::print(report,
             "Chance. An error falls with realizations, as CPU time to the power -1/2: slope is "
             "that of\nthe scatter of disjoint group means.\n\n{}\n",
             table.text());
}

void print_shifts(const Assessment& assessment, std::ostream& report) {
  TextTable table({{"quantity", Align::left},
                   {"e"},
                   {"n"},
                   {"N"},
                   {"cause", Align::left},
                   {"shift"},
                   {"error"},
                   {"in errors"},
                   {"", Align::left}});
  for (const BiasEstimate& each : assessment.shifts)
    table.add({describe(each.quantity), e_text(each.job), number_text(each.job.n),
               count_text(each.job.particles), name(each.cause), fmt::format("{:+.1e}", each.value),
               error_text(each.error),
               each.error > 0 ? fmt::format("{:+.1f}", each.value / each.error) : no_value,
               each.change});
  if (!table.empty())
    fmt::print(
        report,
        "What more realizations do not remove: the shift of the mean. A shift within two "
        "or three of its\nerrors is not significant, and at most about as large as these.\n\n{}\n",
        table.text());
}

std::vector<Quantity> quantities_in(const Assessment& assessment) {
  std::vector<Quantity> all;
  for (const Statistics& each : assessment.statistics)
    if (std::ranges::find(all, each.quantity) == all.end()) all.push_back(each.quantity);
  return all;
}

// In what two gases differ that started from the same states.
std::string apart(const Difference& each) {
  const auto text = [&](const schema::Job& job) {
    return each.job.e != each.reference.e ? "e " + e_text(job) : job.effects.text();
  };
  return fmt::format("{}, not {}", text(each.job), text(each.reference));
}

void print_differences(const std::vector<Difference>& differences, std::ostream& report) {
  TextTable table({{"quantity", Align::left},
                   {"n"},
                   {"N"},
                   {"seeds"},
                   {"difference"},
                   {"error"},
                   {"if independent"},
                   {"", Align::left}});
  for (const Difference& each : differences)
    table.add({describe(each.quantity), number_text(each.job.n), count_text(each.job.particles),
               count_text(static_cast<long long>(each.difference.pairs)),
               value_text(each.difference.value, each.difference.error),
               error_text(each.difference.error), error_text(each.difference.independent),
               apart(each)});
  if (!table.empty())
    fmt::print(report,
               "Differences of gases that started from the same states, seed by seed: the noise "
               "that both share\nis not part of their error.\n\n{}\n",
               table.text());
}

// Gases that lack the same are named together.
void print_unknown(const Assessment& assessment, std::ostream& report) {
  std::map<std::pair<SystematicEffect, std::string>, std::vector<std::string>>
      quantities;  // by cause and gas
  for (const UnknownBias& each : assessment.unknown)
    quantities[{each.cause, gas_text(each.job)}].push_back(describe(each.quantity));
  std::map<std::pair<SystematicEffect, std::string>, std::vector<std::string>>
      gases;  // ... and quantities
  for (const auto& [key, names] : quantities)
    gases[{key.first, joined(names)}].push_back(key.second);
  for (const auto& [key, names] : gases)
    fmt::print(report, "{}: not known from this store of {} ({}); {}\n", name(key.first),
               key.second, joined(names), plan_for(key.first));
  if (!gases.empty()) fmt::print(report, "\n");
}

// Why no run has the quantity, and what to plan so that one has it.
std::string reason_for(const NotMeasured& absence) {
  const Quantity& quantity = absence.quantity;
  if (quantity.measure == Measure::tau_c) return R"(no run reaches it; plan a larger "tau_max")";
  if (!absence.reached)
    return fmt::format(R"(no run reaches it; plan "tau_max": {:g} or more)", quantity.to);
  if (is_laguerre(quantity.measure))
    return R"(no run measures it; plan with "laguerre" among the "observables")";
  if (quantity.measure == Measure::correlation)
    return fmt::format(
        R"(no run measures it; plan with "correlations" among the "observables", "profiles_every": {:g})",
        quantity.to);
  return "no run measures it";
}

void print_absent(const Assessment& assessment, std::ostream& report) {
  std::vector<std::string> order;
  std::map<std::string, std::vector<std::string>> gases;
  for (const NotMeasured& each : assessment.absent) {
    const std::string line = describe(each.quantity) + ": " + reason_for(each);
    add_once(order, line);
    add_once(gases[line], gas_text(each.job));
  }
  for (const std::string& line : order) fmt::print(report, "{} ({})\n", line, joined(gases[line]));
  if (!order.empty()) fmt::print(report, "\n");
}

// The rounding errors that the runs themselves have recorded.
void print_rounding(const schema::Reader& store, std::ostream& report) {
  fmt::print(report, "Arithmetic: double (engine/decisions/double-precision.md).");
  auto rows = store.query("SELECT max(energy_mismatch), max(largest_overlap) FROM invariants");
  const auto row = rows.next().value();
  const auto* energy = std::get_if<double>(row.data());
  const auto* overlap = std::get_if<double>(&row[1]);
  if (energy != nullptr && overlap != nullptr)
    fmt::print(report,
               " In all runs the energy is balanced to {:.1e}, and overlaps are at most\n{:.1e} "
               "sigma.",
               *energy, *overlap);
  fmt::print(report, "\n\n");
}

// Targets for which there is no advice, although runs have the quantity.
void print_unanswered(const Assessment& assessment, const std::vector<CostTarget>& targets,
                      const std::vector<Advice>& advised, std::ostream& report) {
  for (const CostTarget& asked : targets) {
    const auto meant = [&](const auto& each) { return is_meant(asked, each.quantity); };
    if (std::ranges::any_of(advised, meant) || std::ranges::any_of(assessment.absent, meant))
      continue;
    fmt::print(report, "{}: {}\n\n",
               asked.quantity ? describe(*asked.quantity) : name(asked.measure),
               std::ranges::any_of(assessment.statistics, meant)
                   ? "its error is not known; that takes two realizations"
                   : "not among the usual quantities of these gases; say at which tau, as in "
                     "ln_temperature@50=0.01");
  }
}

void print_advice(const std::vector<Advice>& all, std::ostream& report) {
  TextTable table({{"quantity", Align::left},
                   {"e"},
                   {"n"},
                   {"for an error of"},
                   {"N"},
                   {"runs"},
                   {"CPU time"},
                   {"memory"},
                   {"", Align::left}});
  for (const Advice& each : all) {
    std::vector<std::string> cells{describe(each.quantity), e_text(each.job),
                                   number_text(each.job.n), error_text(each.target)};
    if (each.offer)
      cells.insert(cells.end(),
                   {count_text(each.offer->job.particles),
                    count_text(static_cast<long long>(each.offer->realizations)),
                    duration_text(each.offer->cpu_seconds), bytes_text(each.memory_bytes)});
    else
      cells.insert(cells.end(), {"larger", no_value, no_value, no_value});
    cells.push_back(joined(each.notes));
    table.add(std::move(cells));
  }
  if (!table.empty())
    fmt::print(report,
               "The cheapest way to an error, finite size included (larger: the sizes tried are "
               "too small\nfor it). Memory is that of one worker.\n\n{}\n",
               table.text());
}

}  // namespace

void print_cost_tables(const schema::Reader& store, const std::vector<CostTarget>& targets,
                       const std::vector<FinishedSeries>& finished, const Assessment& assessment,
                       const std::vector<Advice>& advised, std::ostream& report) {
  print_statistics(assessment, report);
  print_shifts(assessment, report);
  print_differences(paired_differences(finished, quantities_in(assessment)), report);
  print_unknown(assessment, report);
  print_rounding(store, report);
  print_absent(assessment, report);
  print_unanswered(assessment, targets, advised, report);
  print_advice(advised, report);
}

}  // namespace haff::campaign
