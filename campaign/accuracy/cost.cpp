#include "campaign/accuracy/cost.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "campaign/accuracy/assessment.hpp"
#include "campaign/accuracy/cost_figure.hpp"
#include "campaign/accuracy/differences.hpp"
#include "campaign/base/output/write_file.hpp"
#include "campaign/base/text/csv.hpp"
#include "campaign/base/text/duration.hpp"
#include "campaign/base/text/job_text.hpp"
#include "campaign/base/text/number_text.hpp"
#include "campaign/base/text/printable.hpp"
#include "campaign/base/text/text_table.hpp"
#include "campaign/planning/forecast.hpp"
#include "campaign/plot/gnuplot.hpp"

namespace haff::campaign {
namespace {

// Errors that advice is given for where none is asked: today's, and less by this.
constexpr double ambition = 10;

constexpr std::string_view pilot_grid = R"({ "e": 0.90, "n": 0.4, "tau_max": 20, "seeds": 16,
  "grids": [ { "N": [2000, 8000, 32000] }, { "N": 8000, "equilibrate": 100 } ] })";

// Fewer leave the scatter, and with it the advice, open to a third.
constexpr std::size_t fewest_runs = 5;

std::string plan_for(SystematicEffect cause) {
  switch (cause) {
    case SystematicEffect::finite_size:
      return R"(plan the same grid with several "N", e.g. "N": [2000, 8000, 32000])";
    case SystematicEffect::equilibration:
      return R"(plan the same grid with "equilibrate": [50, 100])";
    case SystematicEffect::sampling:
      return "needs two realizations, of a gas that has it in each, sampled often";
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

// Names in the order in which they come, each once.
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
    fmt::print(report,
               "What more realizations do not remove: the shift of the mean. Within two or three "
               "of its\nerrors it is not seen, and no larger than about that.\n\n{}\n",
               table.text());
}

std::vector<Quantity> quantities_in(const Assessment& assessment) {
  std::vector<Quantity> all;
  for (const Statistics& each : assessment.statistics)
    if (std::ranges::find(all, each.quantity) == all.end()) all.push_back(each.quantity);
  return all;
}

// What sets two gases apart that started from the same states.
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
               "Differences of gases that started from the same states, seed by seed: what chance "
               "does to both\nalike is not in their error.\n\n{}\n",
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

// Why no run has it, and what to plan so that one has.
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

// What the runs have watched of their rounding themselves.
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

struct Advice {
  Quantity quantity;
  std::string gas;
  schema::Job job;
  double target = 0;
  std::optional<Offer> offer = {};
  double memory_bytes = 0;  // of the offer
  std::vector<std::string> notes = {};
};

bool is_meant(const CostTarget& target, const Quantity& quantity) {
  return target.quantity ? *target.quantity == quantity : target.measure == quantity.measure;
}

// The errors wanted of a quantity: those that name its window before those of its measure.
std::vector<double> errors_wanted(const CostRequest& request, const Quantity& quantity) {
  std::vector<double> named, general;
  for (const CostTarget& target : request.targets)
    if (is_meant(target, quantity)) (target.quantity ? named : general).push_back(target.error);
  return named.empty() ? general : named;
}

// The least error that a size of the gas has today.
double least_error(const Assessment& assessment, const std::string& gas, const Quantity& quantity) {
  double least = std::numeric_limits<double>::infinity();
  for (const Statistics& each : assessment.statistics)
    if (each.quantity == quantity && gas_key(each.job) == gas && each.error > 0)
      least = std::min(least, each.error);
  return least;
}

Advice advise(const Assessment& assessment, Advice wanted, Forecast& forecast) {
  wanted.offer = cheapest(assessment, wanted.gas, wanted.quantity, wanted.target);
  if (wanted.offer) {
    wanted.memory_bytes = forecast.memory_bytes(wanted.offer->job);
    if (wanted.offer->seen < fewest_runs)
      wanted.notes.push_back(fmt::format("rests on the scatter of {} run{}", wanted.offer->seen,
                                         wanted.offer->seen == 1 ? "" : "s"));
  }
  const auto is_complete = [&](const Statistics& each) {
    return each.quantity == wanted.quantity && gas_key(each.job) == wanted.gas &&
           each.unfinished == 0;
  };
  if (std::ranges::none_of(assessment.statistics, is_complete))
    wanted.notes.emplace_back(R"(of no size each run has it: plan a larger "tau_max")");
  if (smaller_might_do(assessment, wanted.gas, wanted.quantity, wanted.target))
    wanted.notes.emplace_back("more runs of the largest gas may allow a smaller one");
  return wanted;
}

// Of each gas and quantity one a target, in the order of the statistics.
std::vector<Advice> advice(const Assessment& assessment, const CostRequest& request,
                           Forecast& forecast) {
  std::vector<Advice> all;
  for (const Statistics& each : assessment.statistics) {
    const std::string gas = gas_key(each.job);
    const auto known = std::ranges::any_of(all, [&](const Advice& advised) {
      return advised.gas == gas && advised.quantity == each.quantity;
    });
    if (known || !(each.error > 0)) continue;
    auto targets = errors_wanted(request, each.quantity);
    if (request.targets.empty()) {
      const double today = least_error(assessment, gas, each.quantity);
      targets = {today, today / ambition};
    }
    for (const double target : targets)
      all.push_back(advise(assessment, {each.quantity, gas, each.job, target}, forecast));
  }
  return all;
}

// What is asked and neither advised on nor absent from the runs.
void print_unanswered(const Assessment& assessment, const CostRequest& request,
                      const std::vector<Advice>& advised, std::ostream& report) {
  for (const CostTarget& asked : request.targets) {
    const auto meant = [&](const auto& each) { return is_meant(asked, each.quantity); };
    if (std::ranges::any_of(advised, meant) || std::ranges::any_of(assessment.absent, meant))
      continue;
    fmt::print(report, "{}: {}\n\n",
               asked.quantity ? describe(*asked.quantity) : name(asked.measure),
               std::ranges::any_of(assessment.statistics, meant)
                   ? "its error is not known; it takes two realizations"
                   : "not usual of these gases; say at which tau, as in ln_temperature@50=0.01");
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

// A row of cost.csv: whose, then whatever the row has. The same rows are printed as JSON.
struct CostRow {
  const char* row;
  Quantity quantity;
  schema::Job job;
  std::string cause;
  std::optional<std::size_t> realizations = {};
  std::optional<double> cpu_seconds = {}, value = {}, error = {}, interval = {}, slope = {},
                        slope_error = {}, correlation_time = {}, memory_bytes = {};
};

std::string csv_of(const std::vector<CostRow>& rows) {
  std::string text =
      csv_row("row", "quantity", "tau_from", "tau_to", "r", "e", "n", "particles", "equilibrate",
              "cause", "realizations", "cpu_seconds", "value", "error", "interval", "slope",
              "slope_error", "correlation_time", "memory_bytes");
  for (const CostRow& row : rows) {
    const Quantity& q = row.quantity;
    const schema::Job& job = row.job;
    text +=
        csv_row(row.row, name(q.measure), q.from, q.to, q.r, job.e, job.n, job.particles,
                job.equilibrate, row.cause, row.realizations, row.cpu_seconds, row.value, row.error,
                row.interval, row.slope, row.slope_error, row.correlation_time, row.memory_bytes);
  }
  return text;
}

template <class T>
nlohmann::ordered_json or_null(const std::optional<T>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json json_of(const std::vector<CostRow>& rows) {
  auto list = nlohmann::ordered_json::array();
  for (const CostRow& row : rows)
    list.push_back({{"row", row.row},
                    {"quantity", name(row.quantity.measure)},
                    {"tau_from", row.quantity.from},
                    {"tau_to", row.quantity.to},
                    {"r", row.quantity.r},
                    {"e", or_null(row.job.e)},
                    {"n", row.job.n},
                    {"particles", row.job.particles},
                    {"equilibrate", row.job.equilibrate},
                    {"cause", row.cause},
                    {"realizations", or_null(row.realizations)},
                    {"cpu_seconds", or_null(row.cpu_seconds)},
                    {"value", or_null(row.value)},
                    {"error", or_null(row.error)},
                    {"interval", or_null(row.interval)},
                    {"slope", or_null(row.slope)},
                    {"slope_error", or_null(row.slope_error)},
                    {"correlation_time", or_null(row.correlation_time)},
                    {"memory_bytes", or_null(row.memory_bytes)}});
  return list;
}

void add_rows(const Statistics& each, std::vector<CostRow>& rows) {
  CostRow mean{.row = "mean",
               .quantity = each.quantity,
               .job = each.job,
               .cause = "chance",
               .realizations = each.realizations,
               .cpu_seconds = static_cast<double>(each.realizations) * each.cpu_seconds,
               .value = each.mean,
               .error = each.error,
               .interval = each.half_interval,
               .correlation_time = each.correlation_time};
  if (each.slope) {
    mean.slope = each.slope->value;
    mean.slope_error = each.slope->error;
  }
  rows.push_back(std::move(mean));
  for (const analysis::GroupScatter& group : each.scatter)
    rows.push_back({.row = "scatter",
                    .quantity = each.quantity,
                    .job = each.job,
                    .cause = "chance",
                    .realizations = group.size,
                    .cpu_seconds = static_cast<double>(group.size) * each.cpu_seconds,
                    .value = group.scatter,
                    .error = group.error});
}

std::vector<CostRow> rows_of(const Assessment& assessment, const std::vector<Advice>& advised) {
  std::vector<CostRow> rows;
  for (const Statistics& each : assessment.statistics) add_rows(each, rows);
  for (const BiasEstimate& each : assessment.shifts)
    rows.push_back({.row = "shift",
                    .quantity = each.quantity,
                    .job = each.job,
                    .cause = each.change,
                    .value = each.value,
                    .error = each.error});
  for (const Advice& each : advised) {
    if (!each.offer) continue;
    rows.push_back({.row = "advice",
                    .quantity = each.quantity,
                    .job = each.offer->job,
                    .cause = "finite size",
                    .realizations = each.offer->realizations,
                    .cpu_seconds = each.offer->cpu_seconds,
                    .value = each.offer->finite_size,
                    .error = each.target,
                    .memory_bytes = each.memory_bytes});
  }
  return rows;
}

// Quantities that are not among the usual ones.
std::vector<Quantity> asked_by(const CostRequest& request) {
  std::vector<Quantity> all;
  for (const CostTarget& target : request.targets) {
    if (target.quantity)
      all.push_back(*target.quantity);
    else if (is_laguerre(target.measure) || target.measure == Measure::tau_c)
      all.push_back(usual_quantity(target.measure));
  }
  return all;
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw std::runtime_error(
        fmt::format("{}: folder cannot be made: {}", folder.string(), error.message()));
}

void print_tables(const schema::Reader& store, const CostRequest& request,
                  const std::vector<FinishedSeries>& finished, const Assessment& assessment,
                  const std::vector<Advice>& advised, std::ostream& report) {
  print_statistics(assessment, report);
  print_shifts(assessment, report);
  print_differences(paired_differences(finished, quantities_in(assessment)), report);
  print_unknown(assessment, report);
  print_rounding(store, report);
  print_absent(assessment, report);
  print_unanswered(assessment, request, advised, report);
  print_advice(advised, report);
}

void print_files(const std::filesystem::path& out, const OutputFiles& pictures,
                 std::ostream& report) {
  fmt::print(report, "Written: {}\n", (out / "cost.csv").string());
  for (const auto& picture : pictures.written())
    fmt::print(report, "         {}\n", picture.string());
  pictures.print_missing(report);
}

void print_json(const std::vector<CostRow>& rows, const std::filesystem::path& out,
                const OutputFiles& pictures, std::ostream& report) {
  auto files = nlohmann::ordered_json::array();
  files.push_back((out / "cost.csv").string());
  for (const auto& picture : pictures.written()) files.push_back(picture.string());
  const nlohmann::ordered_json all{{"rows", json_of(rows)}, {"written", files}};
  report << all.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << '\n';
}

}  // namespace

std::optional<CostTarget> target_from_text(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos) return std::nullopt;
  const auto at = std::min(text.find('@'), equals);
  const auto measure = measure_named(text.substr(0, at));
  const auto error = number_in(text.substr(equals + 1));
  if (!measure || !error || !(*error > 0)) return std::nullopt;
  CostTarget target{.measure = *measure, .error = *error};
  if (at < equals) {
    target.quantity = quantity_at(*measure, text.substr(at + 1, equals - at - 1));
    if (!target.quantity) return std::nullopt;
  }
  return target;
}

int cost(const schema::Reader& store, const CostRequest& request, std::ostream& report) {
  const auto finished = read_finished_runs(store);
  if (finished.empty() && request.json)
    throw std::runtime_error("no cooling run is done: there is nothing to say what accuracy costs");
  if (finished.empty()) {
    fmt::print(report, "No cooling run is done. For what accuracy costs plan, for example\n{}\n",
               pilot_grid);
    return 1;
  }
  const Assessment assessment = assess(finished, store.targets(), asked_by(request));
  Forecast forecast(store.jobs());
  const auto advised = advice(assessment, request, forecast);
  const auto rows = rows_of(assessment, advised);
  if (!request.json) print_tables(store, request, finished, assessment, advised, report);

  make_folder(request.out);
  write_file(request.out / "cost.csv", csv_of(rows));
  const OutputFiles pictures = draw_cost(assessment, request.out);
  if (request.json)
    print_json(rows, request.out, pictures, report);
  else
    print_files(request.out, pictures, report);
  return pictures.is_complete() ? 0 : 1;
}

}  // namespace haff::campaign
