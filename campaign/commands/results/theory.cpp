// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/commands/results/theory.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/direct/table.hpp"
#include "campaign/base/output/output.hpp"
#include "campaign/base/process/exit_code.hpp"
#include "campaign/base/text/csv.hpp"
#include "campaign/base/text/text_table.hpp"
#include "campaign/commands/json_output.hpp"
#include "campaign/curves/theory_curves.hpp"
#include "campaign/curves/theory_point.hpp"

namespace haff::campaign {
namespace {

std::vector<double> range(double from, double to, double step) {
  // Half a step of tolerance, so that rounding loses neither end.
  const auto last = static_cast<std::size_t>((to - from) / step + 1e-9);
  std::vector<double> values;
  for (std::size_t k = 0; k <= last; ++k) values.push_back(from + static_cast<double>(k) * step);
  return values;
}

void print_list(RowFormat format) {
  if (format == RowFormat::json) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const TheoryCurve& curve : theory_curves())
      list.push_back({{"curve", curve.name}, {"of", curve.variable}, {"what", curve.meaning}});
    print_json(list);
    return;
  }
  TextTable table({{"curve", Align::left}, {"of", Align::left}, {"what", Align::left}});
  for (const TheoryCurve& curve : theory_curves())
    table.add({std::string(curve.name), std::string(curve.variable), std::string(curve.meaning)});
  say("{}", table.text());
}

// The values of the curve's variable.
std::vector<double> variable_of(const TheoryCurve& curve, const TheoryOptions& options) {
  const auto usual = [](const std::vector<double>& given, const std::vector<double>& otherwise) {
    return given.empty() ? otherwise : given;
  };
  if (curve.variable == "tau") return usual(options.tau, range(0, 40, 1));
  if (curve.variable == "r") return usual(options.r, range(1, 20, 0.5));
  if (curve.variable == "k") return usual(options.k, range(0.02, 1, 0.02));
  return curve.variable == "e" ? options.e : options.n;
}

double only(const std::vector<double>& values, const char* option, const TheoryCurve& curve) {
  if (values.size() == 1) return values.front();
  throw TheoryError(
      fmt::format("{} is a curve of {}: give one --{}", curve.name, curve.variable, option));
}

void require(bool holds, const std::string& otherwise) {
  if (!holds) throw TheoryError(otherwise);
}

std::string unknown(const TheoryCurve& curve, const std::string& effects) {
  if (curve.treats == Treats::rough)
    return fmt::format(
        "{} is of rough particles: --effects '{{\"roughness\": {{\"beta\": 0.5, \"q\": 0.4}}}}'",
        curve.name);
  if (curve.treats == Treats::mixture)
    return fmt::format(
        "{} is of mixtures: --effects '{{\"mixture\": {{\"fraction\": 0.5, "
        "\"diameter_ratio\": 1, \"mass_ratio\": 0.1}}}}'",
        curve.name);
  return fmt::format("{} is not known with --effects {}", curve.name, effects);
}

TheoryPoint point_of(const TheoryCurve& curve, const TheoryOptions& options) {
  TheoryPoint at;
  at.d = options.d;
  at.b = options.b;
  for (const double e : options.e)
    require(e >= 0 && e <= 1, fmt::format("--e {}: a restitution coefficient is 0 ... 1", e));
  for (const double n : options.n)
    require(n > 0 && n < (options.d == 2 ? 1.15 : 1.41),
            fmt::format("--n {}: spheres cannot be packed so (below 1.41, disks 1.15)", n));
  if (curve.variable != "e") at.e = only(options.e, "e", curve);
  if (curve.variable != "n") at.n = only(options.n, "n", curve);
  if (curve.variable == "r" && !options.tau.empty()) at.tau = only(options.tau, "tau", curve);
  at.gas = {.law = analysis::ConstantRestitution{at.e}, .d = at.d, .n = at.n};
  at.size = {
      .particles = options.particles, .realizations = options.realizations, .seed = options.seed};
  add_effects(options.effects, at);
  if (at.is_shuffled)
    complain(
        "campaign: a shuffle changes nothing where velocities are not correlated: the curve is "
        "that "
        "of the gas without\n");
  return at;
}

std::string cell(double value, RowFormat format) {
  if (format == RowFormat::csv) return csv_field(value);
  if (!std::isfinite(value)) return format == RowFormat::json ? "null" : no_value;
  return format == RowFormat::json ? fmt::format("{:.17g}", value) : fmt::format("{:.6g}", value);
}

void print(const TheoryTable& table, RowFormat format) {
  if (format == RowFormat::json) {
    std::string text = "[";
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
      text += row > 0 ? ",\n  {" : "\n  {";
      for (std::size_t c = 0; c < table.columns.size(); ++c)
        text += fmt::format("{}\"{}\": {}", c > 0 ? ", " : "", table.columns[c],
                            cell(table.rows[row][c], format));
      text += '}';
    }
    say("{}\n]\n", text);
    return;
  }
  std::vector<TextTable::Column> columns;
  for (const std::string& name : table.columns) columns.push_back({name, Align::right});
  TextTable aligned(columns);
  std::string lines = format == RowFormat::csv ? csv_line(table.columns) : "";
  for (const auto& row : table.rows) {
    std::vector<std::string> cells;
    cells.reserve(row.size());
    for (const double value : row) cells.push_back(cell(value, format));
    if (format == RowFormat::csv)
      lines += csv_line(cells);
    else
      aligned.add(std::move(cells));
  }
  say("{}", format == RowFormat::csv ? lines : aligned.text());
}

}  // namespace

std::optional<std::vector<double>> values_from_text(std::string_view text) {
  constexpr double most = 1e6;
  const auto next = [&](char separator) -> std::optional<double> {
    double value = 0;
    const std::size_t length = std::min(text.find(separator), text.size());
    const char* end = text.data() + length;
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
    text.remove_prefix(std::min(length + 1, text.size()));
    return value;
  };
  if (text.find(':') != std::string_view::npos) {
    const auto from = next(':'), to = next(':'), step = next(':');
    if (!from || !to || !step || !text.empty()) return std::nullopt;
    if (!(*step > 0) || !(*to >= *from) || (*to - *from) / *step > most) return std::nullopt;
    return range(*from, *to, *step);
  }
  if (text.empty() || text.back() == ',') return std::nullopt;
  std::vector<double> values;
  while (!text.empty()) {
    const auto value = next(',');
    if (!value) return std::nullopt;
    values.push_back(*value);
  }
  return values;
}

int theory(const TheoryOptions& options) {
  if (options.list) {
    print_list(options.format);
    return exit_complete;
  }
  const TheoryCurve* curve = theory_curve(options.curve);
  require(curve != nullptr,
          options.curve.empty()
              ? "which curve? `campaign theory --list` names them"
              : fmt::format("no theory curve is called {}; `campaign theory --list` names them",
                            options.curve));
  const TheoryPoint at = point_of(*curve, options);
  require(knows(*curve, at), unknown(*curve, options.effects));
  try {
    print(curve->compute(at, variable_of(*curve, options)), options.format);
  } catch (const std::invalid_argument& error) {
    throw TheoryError(error.what());
  } catch (const std::domain_error& error) {
    throw TheoryError(error.what());
  }
  return exit_complete;
}

}  // namespace haff::campaign
