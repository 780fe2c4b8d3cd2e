#include "campaign/accuracy/cost_rows.hpp"

#include <utility>

#include "campaign/base/text/csv.hpp"

namespace haff::campaign {

namespace {

template <class T>
nlohmann::ordered_json or_null(const std::optional<T>& value) {
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

}  // namespace haff::campaign
