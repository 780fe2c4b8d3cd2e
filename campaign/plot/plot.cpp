#include "campaign/plot/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace haff::campaign {
namespace {

// More symbols than this on one curve run into each other.
constexpr std::size_t most_symbols = 40;

// A legend of more lines than this takes smaller type.
constexpr std::ptrdiff_t many_entries = 8;

// Of the picture, where the first panel's axes lie: left, right, bottom, top.
constexpr std::array<double, 4> full_frame = {0.15, 0.965, 0.215, 0.975};

// The caption: characters of a line that fit the picture in any font likely to be there, lines that
// have room below the axes, and their distance in fractions of a picture 480 high.
constexpr std::size_t caption_width = 90;  // of a picture 640 wide
constexpr std::size_t caption_lines = 2;
constexpr double caption_spacing = 0.031;

// Colours by Okabe and Ito (without yellow, which is faint on white), and steps of viridis (S.
// van der Walt and N. Smith), from dark to light but for its faint yellow.
constexpr std::array<std::string_view, 6> okabe_ito = {"#0072B2", "#D55E00", "#009E73",
                                                       "#CC79A7", "#E69F00", "#56B4E9"};
constexpr std::array<std::array<double, 3>, 7> viridis = {{{68, 1, 84},
                                                           {70, 50, 126},
                                                           {54, 92, 141},
                                                           {39, 127, 142},
                                                           {31, 161, 135},
                                                           {74, 193, 109},
                                                           {160, 218, 57}}};

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

// One field of a table: 17 digits, nothing for what does not exist.
std::string field(double value) {
  return std::isfinite(value) ? fmt::format("{:.17g}", value) : "";
}

template <class T>
std::string field(const std::optional<T>& value) {
  if (!value) return "";
  if constexpr (std::is_floating_point_v<T>) return field(*value);
  return fmt::format("{}", *value);
}

double error_at(const Curve& curve, std::size_t i) {
  return i < curve.error.size() ? curve.error[i] : std::nan("");
}

// gnuplot's single quotes: nothing is special but the quote itself.
std::string in_quotes(std::string_view text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

// Blanks that a line must not be broken at: around "=" and within a number.
std::string bound(std::string_view text) {
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char before = i > 0 ? text[i - 1] : ' ';
    const char after = i + 1 < text.size() ? text[i + 1] : ' ';
    const bool keep = before == '=' || after == '=' || (digit(before) && digit(after));
    result += text[i] == ' ' && keep ? std::string("\u00a0") : std::string(1, text[i]);
  }
  return result;
}

// Lines of at most so many characters, broken at blanks.
std::vector<std::string> wrapped(std::string_view text, std::size_t width) {
  const auto length = [](std::string_view utf8) {
    return static_cast<std::size_t>(
        std::ranges::count_if(utf8, [](char c) { return (c & 0xc0) != 0x80; }));
  };
  std::vector<std::string> lines(1);
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(word.size() + 1, text.size()));
    if (lines.back().empty()) {
      lines.back() = word;
    } else if (length(lines.back()) + 1 + length(word) <= width) {
      lines.back().append(" ").append(word);
    } else {
      lines.emplace_back(word);
    }
  }
  return lines;
}

bool drawable(double x, const Axis& axis) {
  return std::isfinite(x) && (!axis.logarithmic || x > 0);
}

// Points that the picture shows of a curve.
std::vector<std::size_t> shown_points(const Curve& curve, const Panel& panel) {
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    if (drawable(curve.x[i], panel.x) && drawable(curve.y[i], panel.y)) shown.push_back(i);
  }
  if (curve.look != Look::symbols || shown.size() <= most_symbols) return shown;
  const std::size_t stride = (shown.size() + most_symbols - 1) / most_symbols;
  std::vector<std::size_t> thinned;
  for (std::size_t i = 0; i < shown.size(); i += stride) thinned.push_back(shown[i]);
  return thinned;
}

// Rows x, y, dx, dy, length: an arrow with its middle at the point.
std::string arrow_block(const Curve& curve, const Panel& panel, const std::string& name,
                        const std::vector<std::size_t>& points) {
  std::string block = name + " << END\n";
  for (const std::size_t i : points) {
    const auto [u, v] = curve.arrow[i];
    if (!std::isfinite(u) || !std::isfinite(v)) continue;
    const double dx = u * panel.arrow_scale, dy = v * panel.arrow_scale;
    block += fmt::format("{:.8g} {:.8g} {:.8g} {:.8g} {:.8g}\n", curve.x[i] - dx / 2,
                         curve.y[i] - dy / 2, dx, dy, std::hypot(u, v));
  }
  return block + "END\n";
}

// Rows x, y, y - error, y + error.
std::string data_block(const Curve& curve, const Panel& panel, const std::string& name,
                       const std::vector<std::size_t>& points) {
  std::string block = name + " << END\n";
  for (const std::size_t i : points) {
    const double y = curve.y[i];
    const double error = std::isfinite(error_at(curve, i)) ? error_at(curve, i) : 0;
    // A logarithmic axis cannot show where an error bar reaches below zero: it leaves the picture.
    const double below = panel.y.logarithmic ? std::max(y - error, 1e-3 * y) : y - error;
    block += fmt::format("{:.8g} {:.8g} {:.8g} {:.8g}\n", curve.x[i], y, below, y + error);
  }
  return block + "END\n";
}

bool has_errors(const Curve& curve) {
  return std::ranges::any_of(curve.error, [](double e) { return e > 0; });
}

std::string dashes(Look look) {
  switch (look) {
    case Look::dashed:
      return "dt (9,5)";
    case Look::dotted:
      return "dt (2,4)";
    default:
      return "dt solid";
  }
}

std::string plot_element(const Curve& curve, const std::string& block) {
  const std::string title = curve.legend.empty() ? "notitle" : "title " + in_quotes(curve.legend);
  const std::string ink = fmt::format("lc rgb '{}'", curve.colour);
  const std::string style =
      curve.look == Look::symbols
          ? fmt::format("points pt {} ps {} lw 1.2 {}", curve.symbol, curve.size, ink)
          : fmt::format("lines lw {} {} {}", curve.width, dashes(curve.look), ink);
  if (block.empty()) return fmt::format("keyentry with {} {}", style, title);
  if (curve.look == Look::arrows) {
    return fmt::format(
        "{} using 1:2:3:4:5 with vectors head size 0.9,22,60 filled lw {} lc palette "
        "notitle",
        block, curve.width);
  }

  std::string errors;
  if (has_errors(curve) && curve.look == Look::symbols) {
    errors =
        fmt::format("{} using 1:3:(0):($4-$3) with vectors nohead lw 1.2 {} notitle, ", block, ink);
  } else if (has_errors(curve)) {
    errors = fmt::format(
        "{} using 1:3:4 with filledcurves fc rgb '{}' fs transparent solid 0.25 noborder "
        "notitle, ",
        block, curve.colour);
  }
  return fmt::format("{}{} using 1:2 with {} {}", errors, block, style, title);
}

std::ptrdiff_t entries(const Panel& panel) {
  return std::ranges::count_if(panel.curves, [](const Curve& c) { return !c.legend.empty(); });
}

bool has_arrows(const Panel& panel) {
  return std::ranges::any_of(panel.curves, [](const Curve& c) { return !c.arrow.empty(); });
}

// Tones from viridis, dark for the fast; the scale stands right of the axes.
std::string tone_commands(const Panel& panel, const std::array<double, 4>& frame) {
  std::string stops;
  for (std::size_t i = 0; i < viridis.size(); ++i) {
    stops += fmt::format("{}{} '{}'", i == 0 ? "" : ", ", i,
                         shade(viridis.size() - 1 - i, viridis.size()));
  }
  return fmt::format("set palette defined ({})\nset cbrange [0:{:.8g}]\nset cbtics {:g}\n{}", stops,
                     panel.tone_high, round_step(panel.tone_high / 5),
                     panel.tone_label.empty()
                         ? std::string("unset colorbox\n")
                         : fmt::format("set colorbox user origin screen {}, screen {} size screen "
                                       "0.012, screen {}\nset cblabel {}\n",
                                       frame[1] + 0.012, frame[2], frame[3] - frame[2],
                                       in_quotes(panel.tone_label)));
}

std::string axis_commands(const Axis& axis, char letter) {
  const auto bound = [](const std::optional<double>& value) {
    return value ? fmt::format("{:.8g}", *value) : std::string("*");
  };
  std::string text = fmt::format("set {}label {}\n", letter, in_quotes(axis.label));
  text += fmt::format("{} logscale {}\n", axis.logarithmic ? "set" : "unset", letter);
  text += fmt::format("set {}range [{}:{}]\n", letter, bound(axis.low), bound(axis.high));
  text += fmt::format("set {}tics {}\n", letter, axis.tics.empty() ? "autofreq" : axis.tics);
  text += fmt::format("set m{}tics {}\n", letter, axis.logarithmic ? "10" : "2");
  return text;
}

}  // namespace

Range y_range(const std::vector<Curve>& curves, bool logarithmic) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Range range{infinity, -infinity};
  const auto include = [&](double y) {
    if (!std::isfinite(y) || (logarithmic && y <= 0)) return;
    range.low = std::min(range.low, y);
    range.high = std::max(range.high, y);
  };
  for (const Curve& curve : curves) {
    for (std::size_t i = 0; i < curve.y.size(); ++i) {
      include(curve.y[i]);
      if (logarithmic) continue;  // bars may reach anywhere
      include(curve.y[i] - error_at(curve, i));
      include(curve.y[i] + error_at(curve, i));
    }
  }
  return range.low <= range.high ? range : Range{0, 1};
}

double decade_below(double value) {
  constexpr double room = 0.3;  // of a decade
  return std::pow(10, std::floor(std::log10(value) - room));
}

double round_step(double at_least) {
  const double power = std::pow(10, std::floor(std::log10(at_least)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (step * power >= at_least) return step * power;
  }
  return 10 * power;
}

std::string colour(std::size_t place, std::size_t of) {
  if (of <= okabe_ito.size()) return std::string(okabe_ito[place % okabe_ito.size()]);
  return shade(place, of);
}

std::string shade(std::size_t place, std::size_t of) {
  const double at = static_cast<double>(place) /
                    static_cast<double>(std::max<std::size_t>(of, 2) - 1) *
                    static_cast<double>(viridis.size() - 1);
  const std::size_t low = std::min(static_cast<std::size_t>(at), viridis.size() - 2);
  const double share = at - static_cast<double>(low);
  std::array<int, 3> mixed{};
  for (std::size_t i = 0; i < 3; ++i) {
    mixed[i] = static_cast<int>(viridis[low][i] + share * (viridis[low + 1][i] - viridis[low][i]));
  }
  return fmt::format("#{:02X}{:02X}{:02X}", mixed[0], mixed[1], mixed[2]);
}

void write_table(const Plot& plot, const std::filesystem::path& file) {
  std::ofstream table(file);
  const Panel& first = plot.panels.front();
  const bool arrows = std::ranges::any_of(plot.panels, has_arrows);
  table << fmt::format("panel,curve,kind,e,n,particles,realizations,{0},{1},{1}_se{2}\n",
                       first.x.column, first.y.column, arrows ? ",u_x,u_y" : "");
  for (const Panel& panel : plot.panels) {
    for (const Curve& curve : panel.curves) {
      for (std::size_t i = 0; i < curve.x.size(); ++i) {
        const bool counted = i < curve.realizations.size();
        table << fmt::format("{},{},{},{},{},{},{},{},{},{}", panel.name, curve.name,
                             word(curve.source), field(curve.e), field(curve.n),
                             field(curve.particles),
                             counted ? fmt::format("{}", curve.realizations[i]) : "",
                             field(curve.x[i]), field(curve.y[i]), field(error_at(curve, i)));
        if (arrows)
          table << fmt::format(",{},{}", field(curve.arrow[i][0]), field(curve.arrow[i][1]));
        table << '\n';
      }
    }
  }
  table.close();
  if (!table) throw std::runtime_error(fmt::format("{}: cannot be written", file.string()));
}

void finish_svg(const Plot& plot, const std::filesystem::path& picture) {
  std::ostringstream read;
  read << std::ifstream(picture).rdbuf();
  std::string text = read.str();
  const auto replace = [&](std::string_view old, const std::string& now) {
    const auto place = text.find(old);
    if (place != std::string::npos) text.replace(place, old.size(), now);
  };
  replace("<svg ", "<svg xml:space=\"preserve\" ");
  replace("<title>Gnuplot</title>", "<title>" + plot.caption + "</title>");
  std::ofstream write(picture);
  write << text;
  write.close();
  if (!write) throw std::runtime_error(fmt::format("{}: cannot be written", picture.string()));
}

std::string gnuplot_script(const Plot& plot, const std::filesystem::path& picture, Format format) {
  const auto lines =
      wrapped(bound(plot.caption), caption_width * static_cast<std::size_t>(plot.width) / 640);
  const auto spare = static_cast<double>(std::max(lines.size(), caption_lines) - caption_lines);
  std::string caption;
  const double scale = 480.0 / plot.height;
  double height = (0.07 + spare * caption_spacing) * scale;
  for (const std::string& line : lines) {
    caption += fmt::format(
        "set label {} at screen 0.02, screen {} left noenhanced font ',9.5' tc rgb '#555555'\n",
        in_quotes(line), height);
    height -= caption_spacing * scale;
  }

  auto first_frame = full_frame;
  first_frame[2] += spare * caption_spacing;
  std::string blocks, panels;
  int count = 0;
  for (const Panel& panel : plot.panels) {
    const auto frame = panel.frame.value_or(first_frame);
    panels += fmt::format(
        "set lmargin at screen {}\nset rmargin at screen {}\n"
        "set bmargin at screen {}\nset tmargin at screen {}\n",
        frame[0], frame[1], frame[2], frame[3]);
    panels += panel.legend == "none"
                  ? "unset key\n"
                  : fmt::format("set key {} Left reverse samplen 2.2 {}\n", panel.legend,
                                entries(panel) > many_entries ? "font ',9' spacing 0.95"
                                                              : "font ',12' spacing 1.15");
    panels += fmt::format("set tics font ',{}'\n", panel.small ? 10 : 12);
    panels += axis_commands(panel.x, 'x') + axis_commands(panel.y, 'y');
    if (has_arrows(panel)) panels += tone_commands(panel, frame);
    for (const std::string& command : panel.commands) panels += command + "\n";
    std::string elements;
    for (const Curve& curve : panel.curves) {
      // gnuplot refuses to plot nothing.
      const auto points = shown_points(curve, panel);
      const std::string block = points.empty() ? "" : fmt::format("$curve{}", count++);
      if (!points.empty()) {
        blocks += curve.arrow.empty() ? data_block(curve, panel, block, points)
                                      : arrow_block(curve, panel, block, points);
      }
      elements += (elements.empty() ? "" : ", ") + plot_element(curve, block);
    }
    panels += "plot " + elements + "\nunset label\nunset arrow\nunset object\n";
  }

  // Arial is what viewers of SVG have or replace by its like (Liberation Sans on Debian).
  const std::string terminal =
      format == Format::svg
          ? fmt::format("svg size {},{} enhanced font 'Arial,12' fontscale 1.3 background 'white'",
                        plot.width, plot.height)
          : fmt::format(
                "pngcairo size {},{} enhanced font 'Arial,12' fontscale 2 linewidth 2 "
                "pointscale 2",
                2 * plot.width, 2 * plot.height);
  return "set encoding utf8\nset terminal " + terminal + "\nset output " +
         in_quotes(picture.string()) + "\n" + blocks +
         "set border 15 lw 1\nset tics in scale 0.8,0.4\n"
         "set format '%g'\nset minussign\nset multiplot\n" +
         caption + panels + "unset multiplot\nset output\n";
}

}  // namespace haff::campaign
