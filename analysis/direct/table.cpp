// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/direct/table.hpp"

#include <gsl/gsl_interp.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "analysis/gsl.hpp"

namespace haff::analysis {

// The text of enskog_boltzmann.csv, made into a source by the build.
std::string_view enskog_boltzmann_csv();

namespace {

constexpr double same_e = 1e-9;  // e is written in decimals

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

double number(std::string_view text) {
  if (text == "inf") return std::numeric_limits<double>::infinity();
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    throw std::runtime_error("enskog_boltzmann.csv: no number: " + std::string(text));
  return value;
}

// All rows, and the names of the columns.
struct Table {
  std::vector<std::string_view> columns;
  std::vector<std::vector<double>> rows;

  std::size_t column(std::string_view name) const {
    const auto found = std::ranges::find(columns, name);
    if (found == columns.end())
      throw std::invalid_argument("the table of direct simulations has no " + std::string(name));
    return static_cast<std::size_t>(found - columns.begin());
  }
};

const Table& table() {
  static const Table read = [] {
    Table result;
    for (const std::string_view line : split(enskog_boltzmann_csv(), '\n')) {
      if (line.empty()) continue;
      const auto cells = split(line, ',');
      if (result.columns.empty()) {
        result.columns = cells;
        continue;
      }
      auto& row = result.rows.emplace_back();
      for (const std::string_view cell : cells) row.push_back(number(cell));
    }
    return result;
  }();
  return read;
}

}  // namespace

std::optional<TabulatedCurve> tabulated(std::string_view quantity, double e, int d) {
  const Table& all = table();
  const std::size_t value = all.column(quantity);
  const std::size_t error = all.column(std::string(quantity) + "_se");
  TabulatedCurve curve;
  for (const auto& row : all.rows) {
    if (row[0] != d || std::abs(row[1] - e) > same_e) continue;
    const TabulatedValue here{.value = row[value], .error = row[error]};
    if (std::isinf(row[2])) {
      curve.plateau = here;
    } else {
      curve.tau.push_back(row[2]);
      curve.points.push_back(here);
    }
  }
  if (curve.tau.empty()) return std::nullopt;
  return curve;
}

TabulatedValue TabulatedCurve::at(double t) const {
  if (t > tau.back()) return plateau;
  std::vector<double> values;
  for (const TabulatedValue& point : points) values.push_back(point.value);
  const gsl::Owned<gsl_interp, gsl_interp_free> spline(
      gsl_interp_alloc(gsl_interp_cspline, tau.size()));
  gsl_interp_init(spline.get(), tau.data(), values.data(), tau.size());
  const auto next = std::ranges::lower_bound(tau, t);
  return {.value = gsl_interp_eval(spline.get(), tau.data(), values.data(), t, nullptr),
          .error = points[static_cast<std::size_t>(next - tau.begin())].error};
}

std::vector<double> tabulated_restitutions(int d) {
  std::vector<double> all;
  for (const auto& row : table().rows)
    if (row[0] == d && (all.empty() || all.back() != row[1])) all.push_back(row[1]);
  return all;
}

}  // namespace haff::analysis
