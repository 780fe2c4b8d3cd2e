// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/sql/mean_views.hpp"

#include <fmt/format.h>

#include <string_view>
#include <vector>

#include "schema/rows/sample_columns.hpp"

namespace haff::schema {

namespace {

// A gas and how it is sampled: jobs that agree in these and in the seed are one realization,
// whichever observables they have.
constexpr const char* gas =
    "e, n, particles, d, start, equilibrate, sample_every, sample_at, effects";

// What is averaged, and where it stands.
struct Source {
  std::string view;
  std::string table;               // beside jobs
  std::vector<std::string> place;  // columns that, with the gas, tell one mean from the next
  std::vector<std::string> averaged;
  std::string where = {};   // which rows of the table
  std::string counts = {};  // further columns of means, beside realizations
};

std::string list(const std::vector<std::string>& columns, std::string_view form) {
  std::string text;
  for (const std::string& column : columns) text += fmt::format(fmt::runtime(form), column);
  return text;
}

// Four steps. `once`: a realization that was run again to observe more is one, and what both runs
// have is the same number. `means`, then `errors`: the standard error of the mean is
// sqrt(sum (x - mean)^2 / (R - 1) / R), NULL for one realization; deviations are taken from the
// mean itself, since <x^2> - <x>^2 loses every digit of a late temperature. Finally there is one
// row for each mean.
//
// Sums run over windows ordered by seed, so that an average does not depend, even in the last bit,
// on the order in which jobs were planned or finished. Each step keeps the columns of the gas and
// divides by them, so that SQLite can take a condition such as e = 0.9 down to the table jobs and
// its index: the rest of the store is not read.
std::string sql_of(const Source& source) {
  const std::string place = list(source.place, ", {}");
  return fmt::format(
      R"(CREATE VIEW {view} AS
WITH
  once AS (
    SELECT {gas}{table_place}, seed{largest}
    FROM jobs JOIN {table} USING (job_id)
    WHERE kind = 'cooling' AND status = 'done'{where}
    GROUP BY {gas}{table_place}, seed
  ),
  means AS (
    SELECT *, count(*) OVER realization AS realizations{means}
    FROM once
    WINDOW realization AS (PARTITION BY {gas}{place} ORDER BY seed
                           ROWS BETWEEN UNBOUNDED PRECEDING AND UNBOUNDED FOLLOWING)
  ),
  errors AS (
    SELECT {gas}{place}, realizations, row_number() OVER realization AS row_of_mean{squares}
    FROM means
    WINDOW realization AS (PARTITION BY {gas}{place} ORDER BY seed
                           ROWS BETWEEN UNBOUNDED PRECEDING AND UNBOUNDED FOLLOWING)
  )
SELECT d, e, n, particles, start, equilibrate, sample_every, sample_at, effects{place},
       realizations{counts}{results}
FROM errors
WHERE row_of_mean = 1
ORDER BY d, n, particles, e, start, equilibrate, sample_every, sample_at, effects{place})",
      fmt::arg("view", source.view), fmt::arg("gas", gas), fmt::arg("place", place),
      fmt::arg("table_place", list(source.place, fmt::format(", {}.{{0}}", source.table))),
      fmt::arg("table", source.table), fmt::arg("where", source.where),
      fmt::arg("largest",
               list(source.averaged, fmt::format(", max({}.{{0}}) AS {{0}}", source.table))),
      fmt::arg("means",
               list(source.averaged, ",\n           avg({0}) OVER realization AS mean_{0}")),
      fmt::arg("squares",
               list(source.averaged,
                    ",\n           mean_{0}, count({0}) OVER realization AS count_{0}, "
                    "avg(({0} - mean_{0}) * ({0} - mean_{0})) OVER realization AS variance_{0}")),
      fmt::arg("counts", source.counts),
      fmt::arg("results",
               list(source.averaged,
                    ",\n       mean_{0} AS {0}, sqrt(variance_{0} / (count_{0} - 1)) AS {0}_se")));
}

// Each sample beside the parameters of its job. The table jobs comes first, so that a condition on
// a gas is looked up there, and then one on tau in the key of samples.
std::string series_view() {
  std::string columns;
  for (const SampleColumn& column : sample_columns) columns += fmt::format(", {}", column.name);
  return fmt::format(
      R"(CREATE VIEW series AS
SELECT job_id, kind, status, d, e, n, particles, seed, start, equilibrate, sample_every, sample_at,
       effects, tau_max, tau, time{}
FROM jobs CROSS JOIN samples USING (job_id))",
      columns);
}

Source mean_of_samples(const char* view, MeanView which) {
  Source source{.view = view, .table = "samples", .place = {"tau"}, .averaged = {}};
  if (which == MeanView::series) source.averaged.emplace_back("time");
  for (const SampleColumn& column : sample_columns)
    if (column.view == which || column.view == MeanView::both)
      source.averaged.emplace_back(column.name);
  return source;
}

}  // namespace

std::string mean_views_script() {
  Source temperatures = mean_of_samples("mean_temperatures", MeanView::temperatures);
  temperatures.where = " AND (rotational_temperature IS NOT NULL OR temperature_1 IS NOT NULL)";
  // tau_c is averaged over the realizations that reached it. Where some did not, tau_max was too
  // small and the mean is biased low.
  const Source tau_c{.view = "mean_tau_c",
                     .table = "results",
                     .place = {},
                     .averaged = {"tau_c"},
                     .counts = ", count_tau_c AS reached"};
  const Source profiles{.view = "mean_profiles",
                        .table = "profiles",
                        .place = {"name", "tau", "x"},
                        .averaged = {"value"}};
  std::string script;
  for (const Source& source :
       {mean_of_samples("mean_series", MeanView::series), temperatures, tau_c, profiles})
    script += fmt::format("DROP VIEW IF EXISTS {};\n{};\n", source.view, sql_of(source));
  return script + fmt::format("DROP VIEW IF EXISTS series;\n{};\n", series_view());
}

}  // namespace haff::schema
