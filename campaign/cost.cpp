#include "campaign/cost.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <system_error>

#include "campaign/assessment.hpp"
#include "campaign/cost_figure.hpp"
#include "campaign/duration.hpp"
#include "campaign/forecast.hpp"
#include "campaign/gnuplot.hpp"
#include "campaign/job_text.hpp"
#include "campaign/text_table.hpp"

namespace haff::campaign {
namespace {

// Errors that advice is given for where none is asked: today's, and less by this.
constexpr double ambition = 10;

constexpr std::string_view pilot_grid = R"({ "e": 0.90, "n": 0.4, "tau_max": 20, "seeds": 16,
  "grids": [ { "N": [2000, 8000, 32000] }, { "N": 8000, "equilibrate": 100 } ] })";

std::string plan_for(Cause cause) {
  switch (cause) {
    case Cause::finite_size:
      return R"(plan the same grid with several "N", e.g. "N": [2000, 8000, 32000])";
    case Cause::equilibration:
      return R"(plan the same grid with "equilibrate": [50, 100])";
    case Cause::sampling:
    case Cause::averaging:
      return "needs two realizations";
    case Cause::mesh:
      return R"(needs two realizations with "correlations" in a box of more than 16 sigma)";
  }
  return "";
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
    std::string rest;
    if (each.correlation_time)
      rest = fmt::format("blocks over tau, correlation time {:.2g}", *each.correlation_time);
    else if (each.realizations == 1)
      rest = "one run: no error";
    if (each.unfinished > 0) rest = fmt::format("too early: {} runs ended before", each.unfinished);
    if (each.job.equilibrate != schema::Job{}.equilibrate)
      rest += fmt::format("{}equilibrate {:g}", rest.empty() ? "" : ", ", each.job.equilibrate);
    if (each.job.effects != schema::Job{}.effects)
      rest += (rest.empty() ? "" : ", ") + each.job.effects;
    table.add({describe(each.quantity), e_text(each.job), number_text(each.job.n),
               count_text(each.job.particles),
               count_text(static_cast<long long>(each.realizations)),
               value_text(each.mean, each.error), error_text(each.error),
               std::isfinite(each.half_interval) ? "± " + error_text(each.half_interval) : no_value,
               fmt::format("{:.3g}", each.cpu_seconds),
               error_text(each.deviation * std::sqrt(each.cpu_seconds)),
               each.slope ? fmt::format("{:.2f} ± {:.2f}", each.slope->value, each.slope->error)
                          : no_value,
               rest});
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
  for (const Shift& each : assessment.shifts)
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
  for (const Cause cause : assessment.unknown)
    fmt::print(report, "{}: not known from this store; {}\n", name(cause), plan_for(cause));
}

// The engine computes in double alone: what the runs themselves have watched of its rounding. That
// 2^29 times as much, in single precision, shifts nothing has been measured (README, What accuracy
// costs).
void print_precision(const schema::Reader& store, std::ostream& report) {
  auto rows = store.query("SELECT max(energy_mismatch), max(largest_overlap) FROM invariants");
  const auto row = rows.next().value();
  const auto* energy = std::get_if<double>(row.data());
  const auto* overlap = std::get_if<double>(&row[1]);
  if (energy == nullptr || overlap == nullptr) return;
  fmt::print(
      report,
      "Arithmetic: double. Of all runs energy is balanced to {:.1e}, overlaps are at most "
      "{:.1e} sigma.\nA shift by rounding is not seen even in single precision, which rounds "
      "2^29 times as\ncoarsely (README, What accuracy costs).\n\n",
      *energy, *overlap);
}

struct Advice {
  Quantity quantity;
  std::string gas;
  schema::Job job;
  double target = 0;
  std::optional<Offer> offer = {};
};

// Of each gas and quantity one a target, in the order of the statistics.
std::vector<Advice> advice(const Assessment& assessment, const CostRequest& request) {
  std::vector<Advice> all;
  for (const Statistics& each : assessment.statistics) {
    const std::string gas = gas_key(each.job);
    const auto known = std::ranges::any_of(all, [&](const Advice& advised) {
      return advised.gas == gas && advised.quantity == each.quantity;
    });
    if (known || !(each.error > 0)) continue;
    std::vector<double> targets;
    if (request.targets.empty()) {
      double today = each.error;
      for (const Statistics& other : assessment.statistics)
        if (other.quantity == each.quantity && gas_key(other.job) == gas && other.error > 0)
          today = std::min(today, other.error);
      targets = {today, today / ambition};
    } else if (const auto asked = request.targets.find(name(each.quantity.measure));
               asked != request.targets.end()) {
      targets = {asked->second};
    }
    for (const double target : targets)
      all.push_back(
          {each.quantity, gas, each.job, target, cheapest(assessment, gas, each.quantity, target)});
  }
  return all;
}

void print_advice(const std::vector<Advice>& all, Forecast& forecast, std::ostream& report) {
  TextTable table({{"quantity", Align::left},
                   {"e"},
                   {"n"},
                   {"for an error of"},
                   {"N"},
                   {"runs"},
                   {"CPU time"},
                   {"memory"}});
  for (const Advice& each : all) {
    std::vector<std::string> cells{describe(each.quantity), e_text(each.job),
                                   number_text(each.job.n), error_text(each.target)};
    if (each.offer)
      cells.insert(cells.end(), {count_text(each.offer->job.particles),
                                 count_text(static_cast<long long>(each.offer->realizations)),
                                 duration_text(each.offer->cpu_seconds),
                                 bytes_text(forecast.memory_bytes(each.offer->job))});
    else
      cells.insert(cells.end(), {"larger", no_value, no_value, no_value});
    table.add(std::move(cells));
  }
  if (!table.empty())
    fmt::print(report,
               "The cheapest way to an error, finite size included (larger: the sizes tried are "
               "too small\nfor it). Memory is that of one worker.\n\n{}\n",
               table.text());
}

std::string field(double value) {
  return std::isfinite(value) ? fmt::format("{:.17g}", value) : "";
}

void write_csv(const Assessment& assessment, const std::vector<Advice>& advised,
               const std::filesystem::path& file) {
  std::ofstream csv(file);
  csv << "row,quantity,tau_from,tau_to,r,e,n,particles,equilibrate,precision,cause,realizations,"
         "cpu_seconds,value,error,interval,slope,slope_error,correlation_time\n";
  const auto begin = [&](const char* row, const Quantity& q, const schema::Job& job,
                         const std::string& cause) {
    csv << fmt::format("{},{},{},{},{},{},{},{},{},{},{}", row, name(q.measure), field(q.from),
                       field(q.to), field(q.r),
                       field(job.e.value_or(std::numeric_limits<double>::quiet_NaN())),
                       field(job.n), job.particles, field(job.equilibrate), job.precision, cause);
  };
  for (const Statistics& each : assessment.statistics) {
    begin("mean", each.quantity, each.job, "chance");
    const auto runs = static_cast<double>(each.realizations);
    csv << fmt::format(",{},{},{},{},{},{},{},{}\n", each.realizations,
                       field(runs * each.cpu_seconds), field(each.mean), field(each.error),
                       field(each.half_interval), each.slope ? field(each.slope->value) : "",
                       each.slope ? field(each.slope->error) : "",
                       each.correlation_time ? field(*each.correlation_time) : "");
    for (const analysis::GroupScatter& group : each.scatter) {
      begin("scatter", each.quantity, each.job, "chance");
      csv << fmt::format(",{},{},{},{},,,,\n", group.size,
                         field(static_cast<double>(group.size) * each.cpu_seconds),
                         field(group.scatter), field(group.error));
    }
  }
  for (const Shift& each : assessment.shifts) {
    begin("shift", each.quantity, each.job, "\"" + each.change + "\"");
    csv << fmt::format(",,,{},{},,,,\n", field(each.value), field(each.error));
  }
  for (const Advice& each : advised) {
    if (!each.offer) continue;
    begin("advice", each.quantity, each.offer->job, "finite size");
    csv << fmt::format(",{},{},{},{},,,,\n", each.offer->realizations,
                       field(each.offer->cpu_seconds), field(each.offer->finite_size),
                       field(each.target));
  }
  csv.close();
  if (!csv) throw std::runtime_error(fmt::format("{}: cannot be written", file.string()));
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw std::runtime_error(
        fmt::format("{}: folder cannot be made: {}", folder.string(), error.message()));
}

}  // namespace

std::optional<std::pair<std::string, double>> target_from_text(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || !measure_named(text.substr(0, equals))) return std::nullopt;
  double error = 0;
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data() + equals + 1, end, error);
  if (read.ec != std::errc() || read.ptr != end || !(error > 0)) return std::nullopt;
  return std::pair(text.substr(0, equals), error);
}

int cost(const schema::Reader& store, const CostRequest& request, std::ostream& report) {
  const Assessment assessment = assess(read_pilots(store));
  if (assessment.statistics.empty()) {
    fmt::print(report, "No cooling run is done. For what accuracy costs plan, for example\n{}\n",
               pilot_grid);
    return 1;
  }
  Forecast forecast(store.jobs());
  const auto advised = advice(assessment, request);
  print_statistics(assessment, report);
  print_shifts(assessment, report);
  print_precision(store, report);
  print_advice(advised, forecast, report);

  make_folder(request.out);
  write_csv(assessment, advised, request.out / "cost.csv");
  fmt::print(report, "Written: {}\n", (request.out / "cost.csv").string());
  try {
    for (const std::string& picture : draw_cost(assessment, request.out))
      fmt::print(report, "         {}\n", picture);
  } catch (const GnuplotMissing& missing) {
    fmt::print(report, "{}\n", missing.what());
    return 1;
  }
  return 0;
}

}  // namespace haff::campaign
