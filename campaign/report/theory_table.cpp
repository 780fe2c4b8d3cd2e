// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/report/theory_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <variant>

#include "campaign/curves/theory_lines.hpp"
#include "campaign/curves/vocabulary.hpp"
#include "campaign/plot/text_picture.hpp"

namespace haff::campaign {
namespace {

using schema::Value;

constexpr const char* gas_columns = "d, e, n, particles, equilibrate, sample_every, effects";
constexpr std::size_t gas_width = 7;

// Theory is given where the gas is measured: at the first places, where it forgets how it began,
// and at some of the later ones. Where there are more profiles than this, only the last one of each
// gas has theory. A place takes up to a millisecond, and a hundred bytes of the page.
constexpr std::size_t first_points = 12;
constexpr std::size_t later_points = 20;
constexpr std::size_t most_profiles = 200;

constexpr std::array columns{
    "temperature", "gamma_ratio",       "collision_rate",        "pressure", "a2", "a3", "a4", "a5",
    "a6",          "correlation_trace", "rotational_temperature"};

double real(const Value& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  const auto* number = std::get_if<double>(&value);
  return number == nullptr ? NAN : *number;
}

schema::Job job_of(const std::vector<Value>& row) {
  schema::Job job;
  job.d = static_cast<int>(real(row[0]));
  if (const double e = real(row[1]); std::isfinite(e)) job.e = e;
  job.n = real(row[2]);
  job.particles = static_cast<std::uint32_t>(real(row[3]));
  job.equilibrate = real(row[4]);
  job.sample_every = real(row[5]);
  if (const auto* effects = std::get_if<std::string>(&row[6])) job.effects = *effects;
  return job;
}

// Rows of one gas and what else they share, in the store's order, with a number each.
struct Group {
  std::vector<Value> common;
  std::vector<double> x;
};

std::vector<Group> groups(const schema::Reader& store, const std::string& sql) {
  std::vector<Group> all;
  auto rows = store.query(sql);
  while (auto row = rows.next()) {
    const double x = real(row->back());
    row->pop_back();
    if (all.empty() || all.back().common != *row)
      all.push_back({.common = *std::move(row), .x = {}});
    all.back().x.push_back(x);
  }
  return all;
}

// The first values, every k-th of the others, and the last one.
std::vector<double> thinned(const std::vector<double>& values) {
  const std::size_t stride = values.size() / later_points + 1;
  std::vector<double> few;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (i < first_points || i % stride == 0 || i + 1 == values.size()) few.push_back(values[i]);
  return few;
}

// Averages over the interval before their sample are drawn at its middle.
std::vector<double> places_of(std::string_view column, const schema::Job& job,
                              std::vector<double> tau) {
  if (!is_of_interval(column)) return tau;
  for (double& each : tau) each -= job.sample_every / 2;
  std::erase_if(tau, [](double each) { return each < 0; });
  return tau;
}

// "a₂" of "{/:Italic a}_2".
std::string plain(const std::string& legend) {
  std::string text = without_markup(legend);
  for (const auto& [marked, letter] : {std::pair{"_2", "₂"}, std::pair{"^2", "²"}})
    if (const auto at = text.find(marked); at != std::string::npos) text.replace(at, 2, letter);
  return text;
}

class Rows {
 public:
  void add(const std::vector<Value>& gas, const std::string& name, const Value& tau,
           const TheoryLine& line, const std::vector<double>& x, const std::vector<double>& time) {
    for (std::size_t i = 0; i < line.values.size(); ++i) {
      if (!std::isfinite(line.values[i])) continue;
      std::vector<Value> row(gas.begin(), gas.begin() + gas_width);
      row.insert(row.end(),
                 {Value(name), tau, Value(plain(line.legend)), Value(x[i]),
                  time.empty() ? Value(schema::Null{}) : Value(time[i]), Value(line.values[i])});
      rows_.push_back(std::move(row));
    }
  }
  std::vector<std::vector<Value>> take() { return std::move(rows_); }

 private:
  std::vector<std::vector<Value>> rows_;
};

void add_columns(const schema::Reader& store, Rows& rows) {
  for (const Group& gas : groups(
           store, fmt::format("SELECT {0}, tau FROM mean_series ORDER BY {0}, tau", gas_columns))) {
    const schema::Job job = job_of(gas.common);
    for (const char* column : columns) {
      const auto tau = places_of(column, job, thinned(gas.x));
      for (const TheoryLine& line : theory_in_tau(column, job, tau, Simulations::left_out))
        rows.add(gas.common, column, schema::Null{}, line, tau,
                 times_of(line, job, tau, Simulations::left_out));
    }
  }
}

void add_profiles(const schema::Reader& store, Rows& rows) {
  const auto all = groups(store, fmt::format("SELECT {0}, name, tau, x FROM mean_profiles "
                                             "ORDER BY {0}, name, tau DESC, x",
                                             gas_columns));
  const std::vector<Value>* before = nullptr;
  for (const Group& profile : all) {
    const auto& common = profile.common;
    constexpr std::ptrdiff_t with_name = gas_width + 1;
    const bool is_last = before == nullptr ||
                         !std::equal(common.begin(), common.begin() + with_name, before->begin());
    before = &common;
    const auto* name = std::get_if<std::string>(&common[gas_width]);
    if (name == nullptr || (all.size() > most_profiles && !is_last)) continue;
    const Value& tau = common[with_name];
    const auto x = thinned(profile.x);
    for (const TheoryLine& line : theory_of_profile(*name, job_of(common), real(tau), x))
      rows.add(common, *name, tau, line, x, {});
  }
}

}  // namespace

schema::ComputedTable theory_table(const schema::Reader& store) {
  Rows rows;
  add_columns(store, rows);
  add_profiles(store, rows);
  return {.name = "theory",
          .columns = {"d", "e", "n", "particles", "equilibrate", "sample_every", "effects", "name",
                      "tau", "line", "x", "time", "value"},
          .rows = rows.take()};
}

}  // namespace haff::campaign
