#include "campaign/plot/table.hpp"

#include <algorithm>
#include <stdexcept>
#include <string_view>

#include "campaign/base/csv.hpp"
#include "campaign/base/write_file.hpp"

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

// A row's fields but for its arrow.
std::vector<std::string> point(const Panel& panel, const Curve& curve, std::size_t i) {
  const bool counted = i < curve.realizations.size();
  return {csv_field(panel.name),
          csv_field(curve.name),
          csv_field(word(curve.source)),
          csv_field(curve.e),
          csv_field(curve.n),
          csv_field(curve.particles),
          counted ? csv_field(curve.realizations[i]) : "",
          csv_field(curve.x[i]),
          csv_field(curve.y[i]),
          csv_field(curve.error_at(i))};
}

}  // namespace

void write_table(const Plot& plot, const std::filesystem::path& file) {
  const Panel& first = plot.panels.front();
  const bool arrows = std::ranges::any_of(plot.panels, has_arrows);
  std::vector<std::string> columns{"panel",
                                   "curve",
                                   "kind",
                                   "e",
                                   "n",
                                   "particles",
                                   "realizations",
                                   first.x.column,
                                   first.y.column,
                                   first.y.column + "_se"};
  if (arrows) columns.insert(columns.end(), {"u_x", "u_y"});
  std::string text = csv_line(columns);
  for (const Panel& panel : plot.panels) {
    for (const Curve& curve : panel.curves) {
      for (std::size_t i = 0; i < curve.x.size(); ++i) {
        auto fields = point(panel, curve, i);
        if (arrows)
          for (const double part : curve.arrow[i]) fields.push_back(csv_field(part));
        text += csv_line(fields);
      }
    }
  }
  write_file(file, text);
}

}  // namespace haff::campaign
