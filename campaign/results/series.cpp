// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/results/series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <variant>
#include <vector>

#include "analysis/statistics/statistics.hpp"
#include "campaign/base/text/job_text.hpp"
#include "campaign/base/text/number_text.hpp"
#include "campaign/base/text/text_table.hpp"
#include "campaign/results/averages.hpp"
#include "campaign/results/published.hpp"

namespace haff::campaign {
namespace {

std::string fields_at(const schema::Job& job) {
  return job.fields_at.empty() ? "" : schema::fields_at_text(job.fields_at);
}

// tau_c of the finished realizations that reached it, by series.
std::map<std::string, std::vector<double>> reached_tau_c(const schema::Reader& store) {
  store.must_match_digests({schema::Part::results});
  auto rows = store.query(
      "SELECT series, tau_c FROM results JOIN jobs USING (job_id) "
      "WHERE kind = 'cooling' AND status = 'done' AND tau_c IS NOT NULL ORDER BY series, seed");
  std::map<std::string, std::vector<double>> reached;
  while (const auto row = rows.next())
    reached[std::get<std::string>(row->at(0))].push_back(std::get<double>(row->at(1)));
  return reached;
}

// The most by which tau_c comes out early: ln(T/T_Haff) is convex, and in the middle between two
// rows a straight line lies above it by curvature sample_every^2/8. The ratio of curvature and
// slope is 2.8 ... 4.4 / tau_c by the energy equation, e = 0.8 ... 0.95.
double early(const Series& series) {
  return series.job.sample_every * series.job.sample_every / (2 * *series.tau_c);
}
constexpr double shown_early = 0.02;  // sample_every = 1 stays below it from tau_c = 25 on

std::string tau_c_text(const Series& series) {
  if (!series.tau_c) return no_value;
  const double error = series.tau_c_se ? bar(*series.tau_c_se, series.reached) : 0;
  std::string text = value_with_error(*series.tau_c, error);
  if (series.reached < series.done) text += fmt::format(" ({} of {})", series.reached, series.done);
  return text;
}

// The parameters that distinguish series which agree in d, e, n and N.
class Rest {
 public:
  explicit Rest(const std::vector<Series>& list) {
    std::set<std::tuple<int, std::optional<double>, double, std::uint32_t>> gases;
    for (const Series& series : list) {
      gases.emplace(series.job.d, series.job.e, series.job.n, series.job.particles);
      for (const auto& [key, value] : values(series.job)) values_[key].insert(value);
    }
    is_needed_ = gases.size() < list.size();
  }

  bool is_needed() const { return is_needed_; }

  std::string of(const schema::Job& job) const {
    std::string text;
    for (const auto& [key, value] : values(job))
      if (values_.at(key).size() > 1)
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", key, value);
    return text;
  }

 private:
  static std::map<std::string, std::string> values(const schema::Job& job) {
    return {{"sample_every", number_text(job.sample_every)},
            {"start", schema::start_text(job.start)},
            {"equilibrate", number_text(job.equilibrate)},
            {"observables", schema::observables_text(job.observables)},
            {"profiles_every", job.profiles_every ? number_text(*job.profiles_every) : "none"},
            {"fields_at", fields_at(job)},
            {"sample_at", job.sample_at.empty() ? "none" : schema::schedule_text(job.sample_at)},
            {"snapshots_at",
             job.snapshots_at.empty() ? "none" : schema::schedule_text(job.snapshots_at)},
            {"effects", job.effects.text()}};
  }

  std::map<std::string, std::set<std::string>> values_;
  bool is_needed_ = false;
};

}  // namespace

std::vector<Series> series_of(const schema::Reader& store) {
  std::vector<Series> all;                   // in the order of tables
  std::map<std::string, std::size_t> place;  // in it, by series
  for (const schema::JobRow& row : store.jobs()) {
    if (row.job.kind != schema::Kind::cooling) continue;
    const bool is_done = row.status == schema::Status::done;
    const double tau = is_done ? row.tau_max : row.progress.tau;
    const auto [found, is_new] = place.emplace(row.series, all.size());
    if (is_new)
      all.push_back({.job = row.job, .tau = tau, .published_tau_c = published_tau_c(row.job)});
    Series& series = all[found->second];
    ++series.planned;
    series.done += is_done;
    series.tau = std::min(series.tau, tau);
    series.tau_max = std::max(series.tau_max, row.tau_max);
  }
  for (const auto& [series, reached] : reached_tau_c(store)) {
    const auto found = place.find(series);
    if (found == place.end()) continue;  // planned and done between the two questions
    const auto estimate = analysis::estimate(reached);
    Series& each = all[found->second];
    each.reached = static_cast<int>(reached.size());
    each.tau_c = estimate.mean;
    if (reached.size() > 1) each.tau_c_se = estimate.standard_error;
  }
  return all;
}

std::string series_table(const std::vector<Series>& list) {
  const Rest rest(list);
  const bool has_disks =
      std::any_of(list.begin(), list.end(), [](const Series& s) { return s.job.d == 2; });
  std::vector<TextTable::Column> columns{{"n"},   {"N"},       {"e"},     {"seeds"},    {"done"},
                                         {"tau"}, {"tau_max"}, {"tau_c"}, {"published"}};
  if (has_disks) columns.insert(columns.begin(), {"d"});
  if (rest.is_needed()) columns.push_back({"", Align::left});
  TextTable table(columns);
  bool any_published = false, any_error = false, any_early = false;
  for (const Series& series : list) {
    any_published |= series.published_tau_c.has_value();
    any_error |= series.tau_c_se.has_value();
    any_early |= series.tau_c && early(series) > shown_early;
    std::vector<std::string> cells{
        number_text(series.job.n),
        count_text(series.job.particles),
        series.job.e ? number_text(*series.job.e) : no_value,
        count_text(series.planned),
        count_text(series.done),
        fmt::format("{:.1f}", series.tau),
        number_text(series.tau_max),
        tau_c_text(series),
        series.published_tau_c ? number_text(*series.published_tau_c) : no_value};
    if (has_disks) cells.insert(cells.begin(), std::to_string(series.job.d));
    if (rest.is_needed()) cells.push_back(rest.of(series.job));
    table.add(std::move(cells));
  }
  std::string text = table.text();
  if (any_error) text += "±: 68 % interval of the mean over realizations, by Student's t\n";
  if (any_early)
    text += "tau_c lies between two rows, and comes out early by up to sample_every^2/(2 tau_c)\n";
  if (any_published) text += fmt::format("published: {}\n", published_source);
  return text;
}

}  // namespace haff::campaign
