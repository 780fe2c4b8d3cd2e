// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/accuracy/cost/rows.hpp"

#include <utility>

#include "campaign/base/text/csv.hpp"

namespace haff::campaign {

namespace {

// The columns of cost.csv, in their order, with the row's values.
template <class Visit>
void visit_columns(const CostRow& row, Visit&& visit) {
  visit("row", row.row);
  visit("quantity", name(row.quantity.measure));
  visit("tau_from", row.quantity.from);
  visit("tau_to", row.quantity.to);
  visit("r", row.quantity.r);
  visit("e", row.job.e);
  visit("n", row.job.n);
  visit("particles", row.job.particles);
  visit("equilibrate", row.job.equilibrate);
  visit("cause", row.cause);
  visit("realizations", row.realizations);
  visit("cpu_seconds", row.cpu_seconds);
  visit("value", row.value);
  visit("error", row.error);
  visit("interval", row.interval);
  visit("slope", row.slope);
  visit("slope_error", row.slope_error);
  visit("correlation_time", row.correlation_time);
  visit("memory_bytes", row.memory_bytes);
}

nlohmann::ordered_json json_value(const auto& value) {
  return value;
}
template <class T>
nlohmann::ordered_json json_value(const std::optional<T>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
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

}  // namespace

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

std::string csv_of(const std::vector<CostRow>& rows) {
  std::vector<std::string> names;
  visit_columns(CostRow{}, [&](const char* name, const auto&) { names.emplace_back(name); });
  std::string text = csv_line(names);
  for (const CostRow& row : rows) {
    std::vector<std::string> fields;
    visit_columns(row, [&](const char*, const auto& value) { fields.push_back(csv_field(value)); });
    text += csv_line(fields);
  }
  return text;
}

nlohmann::ordered_json json_of(const std::vector<CostRow>& rows) {
  auto list = nlohmann::ordered_json::array();
  for (const CostRow& row : rows) {
    auto object = nlohmann::ordered_json::object();
    visit_columns(row,
                  [&](const char* name, const auto& value) { object[name] = json_value(value); });
    list.push_back(std::move(object));
  }
  return list;
}

}  // namespace haff::campaign
