#include "campaign/cost_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "campaign/figure.hpp"
#include "campaign/gnuplot.hpp"
#include "campaign/plot.hpp"
#include "campaign/text_table.hpp"

namespace haff::campaign {
namespace {

// Three panels in a row: left, right, bottom, top.
constexpr int picture_width = 960;
constexpr std::array<std::array<double, 4>, 3> frames = {
    {{0.112, 0.337, 0.215, 0.965}, {0.445, 0.67, 0.215, 0.965}, {0.765, 0.99, 0.215, 0.965}}};

// What the panels show, where the gas has it.
bool is_shown(const Quantity& quantity) {
  switch (quantity.measure) {
    case Measure::a2:
    case Measure::tau_c:
      return true;
    case Measure::gamma_ratio:
      return quantity.from < 10;  // the first of the two
    default:
      return false;
  }
}

std::string label(const Quantity& quantity) {
  switch (quantity.measure) {
    case Measure::gamma_ratio:
      return fmt::format("error of {{/:Italic γ}}/{{/:Italic γ}}_0, {{/:Italic τ}} = {:g}…{:g}",
                         quantity.from, quantity.to);
    case Measure::tau_c:
      return "error of {/:Italic τ}_c";
    default:
      return fmt::format("error of {{/:Italic a}}_2, {{/:Italic τ}} = {:g}…{:g}", quantity.from,
                         quantity.to);
  }
}

using Members = std::vector<const Statistics*>;

// By size, those of one preparation: the default one, or whatever there is of that size.
Members one_each_size(const Members& all) {
  std::map<std::uint32_t, const Statistics*> sizes;
  for (const Statistics* each : all) {
    const Statistics*& place = sizes[each->job.particles];
    if (place == nullptr || place->realizations < each->realizations) place = each;
  }
  Members chosen;
  for (const auto& [particles, each] : sizes) chosen.push_back(each);
  return chosen;
}

// One colour a size, in all panels.
using Inks = std::map<std::uint32_t, std::string>;

Inks inks_of(const std::vector<Members>& quantities) {
  Inks inks;
  for (const Members& members : quantities)
    for (const Statistics* each : members) inks[each->job.particles] = "";
  std::size_t place = 0;
  for (auto& [particles, ink] : inks) ink = colour(place++, inks.size());
  return inks;
}

// A shift of more than two of its errors.
bool is_seen(const Shift& shift) {
  return std::abs(shift.value) > 2 * shift.error;
}

struct Reach {
  double low = 0, high = 0;
  void include(double x) {
    if (!(x > 0)) return;
    low = low > 0 ? std::min(low, x) : x;
    high = std::max(high, x);
  }
};

// The measured scatter of one series and the line of slope -1/2 through all its realizations.
void add_series(const Assessment& assessment, const Statistics& each, const std::string& ink,
                bool named, Reach& time, Reach& error, std::vector<Curve>& curves) {
  Curve points{.name = "scatter", .particles = each.job.particles};
  points.look = Look::symbols;
  points.colour = ink;
  if (named) points.legend = fmt::format("{{/:Italic N}} = {}", count_text(each.job.particles));
  for (const analysis::GroupScatter& group : each.scatter) {
    points.x.push_back(static_cast<double>(group.size) * each.cpu_seconds);
    points.y.push_back(group.scatter);
    points.error.push_back(group.error);
    time.include(points.x.back());
    error.include(group.scatter);
  }
  const double all = static_cast<double>(each.realizations) * each.cpu_seconds;
  time.include(all);
  error.include(each.error);

  constexpr double beyond = 100;  // what more CPU time would give
  Curve line{.name = "-1/2", .particles = each.job.particles};
  line.colour = ink;
  line.x = {each.cpu_seconds, beyond * all};
  for (const double x : line.x) line.y.push_back(each.deviation * std::sqrt(each.cpu_seconds / x));
  time.include(line.x.back());
  error.include(line.y.back());

  Curve floor{.name = "finite size", .particles = each.job.particles};
  floor.look = Look::dashed;
  floor.colour = ink;
  if (const Shift* shift = finite_size_shift(assessment, each); shift && is_seen(*shift)) {
    const double size = std::abs(shift->value);
    floor.x = line.x;
    floor.y = {size, size};
    error.include(size);
  }
  curves.insert(curves.end(), {line, points, floor});
}

Panel panel_of(const Assessment& assessment, const Members& members, const Inks& inks,
               std::size_t place) {
  const Quantity& quantity = members.front()->quantity;
  Panel panel{.name = name(quantity.measure),
              .x = {.label = "CPU time [s]", .column = "cpu_seconds", .logarithmic = true},
              .y = {.label = label(quantity), .column = "error", .logarithmic = true},
              .legend = place == 0 ? "bottom left" : "none",
              .small = true,
              .frame = frames[place]};
  Reach time, error;
  for (const Statistics* each : one_each_size(members))
    add_series(assessment, *each, inks.at(each->job.particles), place == 0, time, error,
               panel.curves);
  constexpr double room = 1.6, room_for_legend = 30;
  panel.x.low = time.low / room;
  panel.x.high = time.high * room;
  panel.y.low = error.low / (place == 0 ? room_for_legend : room);
  panel.y.high = error.high * room;
  for (Axis* axis : {&panel.x, &panel.y})
    axis->tics = *axis->high / *axis->low > 1e4 ? "100" : "10";
  return panel;
}

}  // namespace

std::vector<std::string> draw_cost(const Assessment& assessment,
                                   const std::filesystem::path& folder) {
  struct Gas {
    schema::Job job;
    std::vector<Members> quantities;
  };
  std::vector<std::string> order;
  std::map<std::string, Gas> gases;
  for (const Statistics& each : assessment.statistics) {
    if (!is_shown(each.quantity) || each.scatter.empty() || !(each.deviation > 0) ||
        !(each.cpu_seconds > 0))
      continue;
    const std::string key = gas_key(each.job);
    Gas& gas = gases[key];
    if (gas.quantities.empty()) {
      gas.job = each.job;
      order.push_back(key);
    }
    if (gas.quantities.empty() || gas.quantities.back().front()->quantity != each.quantity)
      gas.quantities.emplace_back();
    gas.quantities.back().push_back(&each);
  }

  std::vector<std::string> written;
  for (const std::string& key : order) {
    const Gas& gas = gases[key];
    Plot plot;
    plot.width = picture_width;
    const Inks inks = inks_of(gas.quantities);
    for (const Members& members : gas.quantities)
      if (plot.panels.size() < frames.size())
        plot.panels.push_back(panel_of(assessment, members, inks, plot.panels.size()));
    const std::string e = gas.job.e ? restitution_text(*gas.job.e) : "none";
    plot.caption = fmt::format(
        "n = {}, e = {}. Symbols: standard deviation of the means of disjoint groups of "
        "realizations, with its error. Lines: slope −1/2, as of independent realizations. Dashed: "
        "shift of finite size, where it is seen.",
        density_text(gas.job.n), e);
    const std::string stem = fmt::format("cost-e{}-n{}", e, density_text(gas.job.n));
    const auto svg = folder / (stem + ".svg"), png = folder / (stem + ".png");
    run_gnuplot(gnuplot_script(plot, svg, Format::svg));
    finish_svg(plot, svg);
    run_gnuplot(gnuplot_script(plot, png, Format::png));
    written.push_back(svg.string());
    written.push_back(png.string());
  }
  return written;
}

}  // namespace haff::campaign
