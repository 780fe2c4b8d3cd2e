// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/accuracy/cost/figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include "campaign/accuracy/offer.hpp"
#include "campaign/base/text/number_text.hpp"
#include "campaign/base/text/text_table.hpp"
#include "campaign/plot/colours.hpp"
#include "campaign/plot/picture.hpp"
#include "campaign/plot/plot.hpp"

namespace haff::campaign {
namespace {

// Panels in rows of three, as wide as high about. [pixels]
constexpr std::size_t columns = 3;
constexpr int panel_width = 320, panel_height = 300, room_for_caption = 60;
constexpr int left_of_axes = 92, right_of_axes = 22, below_axes = 62, above_axes = 18;

struct Grid {
  std::size_t panels = 0;
  std::size_t rows() const { return (panels + columns - 1) / columns; }
  bool is_full() const { return panels % columns == 0; }
  bool is_lowest(std::size_t place) const { return place + columns >= panels; }  // of its column
  int width() const { return panel_width * static_cast<int>(columns); }
  int height() const { return panel_height * static_cast<int>(rows()) + room_for_caption; }

  // Left, right, bottom, top of the axes as fractions of the picture.
  std::array<double, 4> frame(std::size_t place) const {
    const int left = panel_width * static_cast<int>(place % columns);
    const int top = height() - panel_height * static_cast<int>(place / columns);
    const double x = width(), y = height();
    return {(left + left_of_axes) / x, (left + panel_width - right_of_axes) / x,
            (top - panel_height + below_axes) / y, (top - above_axes) / y};
  }

  // Of gnuplot's key, drawn with the first panel: in the cell that the last row leaves empty, or
  // where the falling lines leave room.
  std::string legend() const {
    if (is_full()) return "bottom left";
    const auto cell = frame(panels);
    return fmt::format("at screen {:.4f}, screen {:.4f} left top", cell[0], cell[3]);
  }
};

std::string label(const Quantity& quantity) {
  const std::string at = fmt::format("{{/:Italic τ}} = {:g}", quantity.to);
  const std::string window = fmt::format("{{/:Italic τ}} = {:g}…{:g}", quantity.from, quantity.to);
  switch (quantity.measure) {
    case Measure::a2:
    case Measure::a3:
    case Measure::a4:
      return fmt::format("error of {{/:Italic a}}_{}, {}", name(quantity.measure).substr(1),
                         window);
    case Measure::gamma_ratio:
      return "error of {/:Italic γ}/{/:Italic γ}_0, " + window;
    case Measure::ln_temperature:
      return "error of ln {/:Italic T}, " + at;
    case Measure::tau_c:
      return "error of {/:Italic τ}_c";
    case Measure::correlation:
      return fmt::format("error of {{/:Italic G}}_∥, {{/:Italic r}} = {:g}, {}", quantity.r, at);
  }
  throw std::logic_error("unknown measure");
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
bool is_seen(const BiasEstimate& shift) {
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

// Shifts that are seen of this quantity in this series.
std::vector<const BiasEstimate*> seen_shifts(const Assessment& assessment, const Statistics& each) {
  std::vector<const BiasEstimate*> seen;
  const BiasEstimate* of_size = finite_size_shift(assessment, each);
  if (of_size != nullptr && is_seen(*of_size)) seen.push_back(of_size);
  for (const BiasEstimate& shift : assessment.shifts)
    if (shift.cause != SystematicEffect::finite_size && shift.quantity == each.quantity &&
        is_seen(shift) && schema::series_identity(shift.job) == schema::series_identity(each.job))
      seen.push_back(&shift);
  return seen;
}

// The part of both axes that a panel's data take.
struct Extent {
  Reach time, error;
};

// The measured scatter of one series, the line of slope -1/2 through all its realizations, and its
// floors.
void add_series(const Assessment& assessment, const Statistics& each, const std::string& ink,
                Extent& extent, Panel& panel) {
  auto& [time, error] = extent;
  Curve points{.name = "scatter", .particles = each.job.particles};
  points.look = Look::symbols;
  points.colour = ink;
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
  Curve line{.name = "-1/2", .particles = each.job.particles, .width = 0.9};
  line.colour = ink;
  line.x = {each.cpu_seconds, beyond * all};
  for (const double x : line.x) line.y.push_back(each.deviation * std::sqrt(each.cpu_seconds / x));
  time.include(line.x.back());
  error.include(line.y.back());

  panel.curves.insert(panel.curves.end(), {line, points});

  for (const BiasEstimate* shift : seen_shifts(assessment, each)) {
    const double size = std::abs(shift->value);
    const bool is_of_size = shift->cause == SystematicEffect::finite_size;
    // From where the data end, so that it crosses lines alone.
    Curve floor{.name = name(shift->cause), .particles = each.job.particles, .width = 1.4};
    floor.look = is_of_size ? Look::dashed : Look::dotted;
    floor.colour = ink;
    floor.x = {all, line.x.back()};
    floor.y = {size, size};
    error.include(size);
    panel.curves.push_back(floor);
    if (!is_of_size)
      panel.commands.push_back(
          fmt::format("set label '{}' at {:.8g}, {:.8g} right offset 0, 0.4 font ',9' tc rgb '{}'",
                      name(shift->cause), line.x.back(), size, ink));
  }
}

constexpr double room = 1.6;  // at the ends of axes, a factor

// Tics of an axis, a hundred apart where ten would crowd: beyond seven decades.
std::string powers_of_ten(double low, double high) {
  return std::string(high / low > 1e7 ? "100" : "10") + " format '10^{%T}'";
}

// A line of the key for each size, whether or not the first panel has it.
void add_key(const Inks& inks, Panel& panel) {
  for (const auto& [particles, ink] : inks) {
    Curve entry{.legend = fmt::format("{{/:Italic N}} = {}", count_text(particles))};
    entry.look = Look::symbols;
    entry.colour = ink;
    panel.curves.push_back(entry);
  }
}

Panel panel_of(const Assessment& assessment, const Members& members, const Inks& inks,
               const Grid& grid, std::size_t place, Reach& all_times) {
  const Quantity& quantity = members.front()->quantity;
  Panel panel{.name = name(quantity.measure),
              .x = {.label = grid.is_lowest(place) ? "CPU time [s]" : "",
                    .column = "cpu_seconds",
                    .logarithmic = true},
              .y = {.label = label(quantity), .column = "error", .logarithmic = true},
              .legend = place == 0 ? grid.legend() : "none",
              .small = true,
              .frame = grid.frame(place)};
  if (place == 0) add_key(inks, panel);
  Extent extent;
  for (const Statistics* each : one_each_size(members))
    add_series(assessment, *each, inks.at(each->job.particles), extent, panel);
  all_times.include(extent.time.low);
  all_times.include(extent.time.high);
  const Reach& error = extent.error;
  constexpr double room_for_legend = 30;
  panel.y.low = error.low / (place == 0 && grid.is_full() ? room_for_legend : room);
  panel.y.high = error.high * room;
  panel.y.tics = powers_of_ten(*panel.y.low, *panel.y.high);
  return panel;
}

// One axis of time for all panels, which can then be compared.
void share_times(const Reach& times, std::vector<Panel>& panels) {
  for (Panel& panel : panels) {
    panel.x.low = times.low / room;
    panel.x.high = times.high * room;
    panel.x.tics = powers_of_ten(*panel.x.low, *panel.x.high);
  }
}

// What a gas is besides its n and e: gases that differ in it alone are different pictures.
std::string other_properties(const schema::Job& job) {
  std::string text = job.d == 2 ? "disks" : "";
  if (!job.effects.none()) text += (text.empty() ? "" : ", ") + job.effects.text();
  return text;
}

// As part of a file's name: "-shuffle-every-1.0".
std::string as_name(const std::string& text) {
  std::string name;
  bool in_word = false;
  for (const char c : text) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '.' || c == '_';
    if (plain) name += in_word ? std::string(1, c) : std::string("-") + c;
    in_word = plain;
  }
  return name;
}

}  // namespace

OutputFiles draw_cost(const Assessment& assessment, const std::filesystem::path& folder) {
  struct Gas {
    schema::Job job;
    std::vector<Members> quantities;
  };
  std::vector<std::string> order;
  std::map<std::string, Gas> gases;
  for (const Statistics& each : assessment.statistics) {
    if (each.scatter.empty() || !(each.deviation > 0) || !(each.cpu_seconds > 0)) continue;
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

  OutputFiles pictures;
  for (const std::string& key : order) {
    const Gas& gas = gases[key];
    Plot plot;
    const Grid grid{gas.quantities.size()};
    plot.width = grid.width();
    plot.height = grid.height();
    const Inks inks = inks_of(gas.quantities);
    Reach times;
    for (const Members& members : gas.quantities)
      plot.panels.push_back(panel_of(assessment, members, inks, grid, plot.panels.size(), times));
    share_times(times, plot.panels);
    const std::string e = gas.job.e ? restitution_text(*gas.job.e) : "none";
    const std::string others = other_properties(gas.job);
    plot.caption = fmt::format(
        "n = {}, e = {}{}. Symbols: standard deviation of the means of disjoint groups of "
        "realizations, with its error. Lines: slope −1/2, as of independent realizations. Dashed: "
        "shift of finite size, dotted: of the cause named, where it is more than two of its "
        "errors.",
        density_text(gas.job.n), e, others.empty() ? "" : ", " + others);
    const std::string stem =
        fmt::format("cost-e{}-n{}{}", e, density_text(gas.job.n), as_name(others));
    draw_both(plot, folder / stem, pictures);
  }
  return pictures;
}

}  // namespace haff::campaign
