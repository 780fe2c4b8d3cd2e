#include "campaign/results/series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <variant>

#include "campaign/base/job_text.hpp"
#include "campaign/base/number_text.hpp"
#include "campaign/base/text_table.hpp"
#include "campaign/results/averages.hpp"
#include "campaign/results/published.hpp"

namespace haff::campaign {
namespace {

// Equal for realizations of one series, and ordered as tables are.
using Key = std::tuple<int, double, std::int64_t, std::optional<double>, double, double,
                       std::string, std::string, std::optional<double>, std::string>;

std::string fields_at(const schema::Job& job) {
  return job.fields_at.empty() ? "" : schema::fields_at_text(job.fields_at);
}

Key key_of(const schema::Job& job) {
  return {job.d,
          job.n,
          job.particles,
          job.e,
          job.equilibrate,
          job.sample_every,
          job.effects,
          schema::observables_text(job.observables),
          job.profiles_every,
          fields_at(job)};
}

struct TauC {
  int reached = 0;
  std::optional<double> mean;
  std::optional<double> error;
};

std::optional<double> real_or_null(const schema::Value& value) {
  const double* number = std::get_if<double>(&value);
  return number ? std::optional(*number) : std::nullopt;
}

std::map<Key, TauC> mean_tau_c(const schema::Reader& store) {
  auto rows = store.query(
      "SELECT d, n, particles, e, equilibrate, sample_every, effects, observables, "
      "profiles_every, coalesce(fields_at, ''), reached, tau_c, tau_c_se FROM mean_tau_c");
  std::map<Key, TauC> means;
  while (const auto row = rows.next()) {
    const auto integer = [&](std::size_t k) { return std::get<std::int64_t>((*row)[k]); };
    const auto real = [&](std::size_t k) { return std::get<double>((*row)[k]); };
    const auto text = [&](std::size_t k) { return std::get<std::string>((*row)[k]); };
    const Key key{static_cast<int>(integer(0)),
                  real(1),
                  integer(2),
                  real_or_null((*row)[3]),
                  real(4),
                  real(5),
                  text(6),
                  text(7),
                  real_or_null((*row)[8]),
                  text(9)};
    means[key] = {static_cast<int>(integer(10)), real_or_null((*row)[11]),
                  real_or_null((*row)[12])};
  }
  return means;
}

std::string tau_c_text(const Series& series) {
  if (!series.tau_c) return no_value;
  const double error = series.tau_c_se ? bar(*series.tau_c_se, series.reached) : 0;
  std::string text = value_with_error(*series.tau_c, error);
  if (series.reached < series.done) text += fmt::format(" ({} of {})", series.reached, series.done);
  return text;
}

// What sets series apart that agree in d, e, n and N: those of the rest that are not all the same.
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
            {"equilibrate", number_text(job.equilibrate)},
            {"observables", schema::observables_text(job.observables)},
            {"profiles_every", job.profiles_every ? number_text(*job.profiles_every) : "none"},
            {"fields_at", fields_at(job)},
            {"effects", job.effects}};
  }

  std::map<std::string, std::set<std::string>> values_;
  bool is_needed_ = false;
};

}  // namespace

std::vector<Series> series_of(const schema::Reader& store) {
  std::map<Key, Series> all;
  for (const schema::JobRow& row : store.jobs()) {
    if (row.job.kind != schema::Kind::cooling) continue;
    const bool is_done = row.status == schema::Status::done;
    const double tau = is_done ? row.tau_max : row.progress.tau;
    Series& series = all[key_of(row.job)];
    if (series.planned == 0) {
      series.job = row.job;
      series.tau = tau;
      series.published_tau_c = published_tau_c(row.job);
    }
    ++series.planned;
    series.done += is_done;
    series.tau = std::min(series.tau, tau);
    series.tau_max = std::max(series.tau_max, row.tau_max);
  }
  for (const auto& [key, mean] : mean_tau_c(store)) {
    const auto found = all.find(key);
    if (found == all.end()) continue;  // planned and done between the two questions
    found->second.reached = mean.reached;
    found->second.tau_c = mean.mean;
    found->second.tau_c_se = mean.error;
  }
  std::vector<Series> list;
  list.reserve(all.size());
  for (auto& [key, series] : all) list.push_back(std::move(series));
  return list;
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
  bool any_published = false, any_error = false;
  for (const Series& series : list) {
    any_published |= series.published_tau_c.has_value();
    any_error |= series.tau_c_se.has_value();
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
  if (any_published) text += fmt::format("published: {}\n", published_source);
  return text;
}

}  // namespace haff::campaign
