// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/plot/table.hpp"

#include <algorithm>
#include <stdexcept>
#include <string_view>

#include "campaign/base/output/write_file.hpp"
#include "campaign/base/text/csv.hpp"

namespace haff::campaign {
namespace {

std::string_view word(Source source) {
  switch (source) {
    case Source::measured:
      return "measured";
    case Source::theory:
      return "theory";
    case Source::published:
      return "published";
  }
  throw std::logic_error("unknown source of a curve");
}

// Names of the further parameters that curves have, in the order in which they come.
std::vector<std::string> further_parameters(const Plot& plot) {
  std::vector<std::string> names;
  for (const Panel& panel : plot.panels)
    for (const Curve& curve : panel.curves)
      for (const auto& [name, value] : curve.parameters)
        if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  return names;
}

std::string parameter(const Curve& curve, const std::string& name) {
  const auto found =
      std::ranges::find(curve.parameters, name, [](const auto& each) { return each.first; });
  return found == curve.parameters.end() ? std::string() : csv_field(found->second);
}

// A row's fields but for its arrow.
std::vector<std::string> point(const Panel& panel, const Curve& curve, std::size_t i,
                               const std::vector<std::string>& further) {
  const bool counted = i < curve.realizations.size();
  std::vector<std::string> fields{
      csv_field(panel.name), csv_field(curve.name), csv_field(word(curve.source)),
      csv_field(curve.e),    csv_field(curve.n),    csv_field(curve.particles)};
  for (const std::string& name : further) fields.push_back(parameter(curve, name));
  fields.insert(fields.end(),
                {counted ? csv_field(curve.realizations[i]) : "", csv_field(curve.x[i]),
                 csv_field(curve.y[i]), csv_field(curve.error_at(i))});
  return fields;
}

}  // namespace

void write_table(const Plot& plot, const std::filesystem::path& file) {
  const Panel& first = plot.panels.front();
  const bool arrows = std::ranges::any_of(plot.panels, has_arrows);
  const auto further = further_parameters(plot);
  std::vector<std::string> columns{"panel", "curve", "kind", "e", "n", "particles"};
  for (const std::string& name : further) columns.push_back(csv_field(name));
  columns.insert(columns.end(), {"realizations", csv_field(first.x.column),
                                 csv_field(first.y.column), csv_field(first.y.column + "_error")});
  if (arrows) columns.insert(columns.end(), {"u_x", "u_y"});
  std::string text = csv_line(columns);
  for (const Panel& panel : plot.panels) {
    for (const Curve& curve : panel.curves) {
      for (std::size_t i = 0; i < curve.x.size(); ++i) {
        auto fields = point(panel, curve, i, further);
        if (arrows)
          for (const double part : curve.arrow[i]) fields.push_back(csv_field(part));
        text += csv_line(fields);
      }
    }
  }
  write_file(file, text);
}

}  // namespace haff::campaign
