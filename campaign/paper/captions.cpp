// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/paper/captions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <vector>

#include "campaign/base/text/number_text.hpp"
#include "campaign/base/text/text_table.hpp"

namespace haff::campaign {

namespace {

// "mean of 6 realizations (3 beyond tau = 20; 1 planned is not done)"
std::string realizations_text(const MeanSeries& series) {
  const std::int64_t most = series.most_realizations();
  std::string text = most == 1 ? "one realization" : fmt::format("mean of {} realizations", most);
  std::string rest;
  for (std::size_t i = 1; i < series.realizations.size(); ++i) {
    if (series.realizations[i] == series.realizations[i - 1]) continue;
    rest += fmt::format("{}{} beyond τ = {:g}", rest.empty() ? "" : ", ", series.realizations[i],
                        series.tau[i - 1]);
  }
  if (series.missing > 0) {
    rest += fmt::format("{}{} planned not done", rest.empty() ? "" : "; ", series.missing);
  }
  return rest.empty() ? text : text + " (" + rest + ")";
}

// Samples of one run remember each other, and each seed's equilibrated state serves all e.
std::string dependence_note(const std::vector<MeanSeries>& series) {
  const bool several_e = series.front().e != series.back().e;
  return several_e ? " Neighbouring τ are correlated; all e start from the same states."
                   : " Neighbouring τ are correlated.";
}

}  // namespace

std::string versions_text(const std::vector<MeanSeries>& series) {
  std::set<std::string> versions;
  for (const MeanSeries& s : series) {
    versions.insert(s.code_versions.begin(), s.code_versions.end());
  }
  return versions.empty() ? "" : fmt::format(" haff {}.", fmt::join(versions, ", "));
}

std::string provenance(const std::vector<MeanSeries>& series) {
  // One of e and n is common to all; of the other, those that share particles and realizations are
  // named together.
  const bool densities = series.front().n != series.back().n;
  struct Group {
    std::string data, list;
  };
  std::vector<Group> groups;  // in the order of the curves
  for (const MeanSeries& s : series) {
    const std::string data =
        fmt::format("N = {}, {}", count_text(s.particles), realizations_text(s));
    auto group = std::ranges::find(groups, data, &Group::data);
    if (group == groups.end()) group = groups.insert(groups.end(), {data, ""});
    std::string& list = group->list;
    list += (list.empty() ? (densities ? "n = " : "e = ") : ", ") +
            (densities ? density_text(s.n) : restitution_text(s.e));
  }
  std::string text = densities ? "e = " + restitution_text(series.front().e)
                               : "n = " + density_text(series.front().n);
  for (const Group& group : groups) text += fmt::format("; {}: {}", group.list, group.data);
  return text + "." + versions_text(series);
}

std::string error_note(const std::vector<MeanSeries>& series) {
  const bool any =
      std::ranges::any_of(series, [](const MeanSeries& s) { return s.most_realizations() > 1; });
  if (!any) return "";
  return " Bars and bands: 68 % intervals of the mean (Student's t)." + dependence_note(series);
}

std::string coefficient_error_note(const std::vector<MeanSeries>& series) {
  return " Bars and bands: 68 % intervals of the mean (Student's t), at least those of Gaussian "
         "velocities." +
         dependence_note(series);
}

std::string contact_value_note() {
  return " Theory: χ of Carnahan and Starling.";
}

}  // namespace haff::campaign
