#include "campaign/figures.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>

#include "campaign/figure.hpp"
#include "campaign/gnuplot.hpp"

namespace haff::campaign {
namespace {

struct Figure {
  int id;
  std::string_view title;
  std::optional<Plot> (*make)(const Averages&);  // none: this version does not draw it
  std::string_view plan;                         // a grid that gives its data
};

constexpr std::string_view four_restitutions =
    R"({ "e": [0.80, 0.85, 0.90, 0.95], "n": 0.4, "N": 32000, "seeds": 3,
  "tau_max": {"0.80": 180, "0.85": 250, "0.90": 400, "0.95": 470},
  "observables": ["temperature", "laguerre"] })";
constexpr std::string_view one_restitution =
    R"({ "e": 0.90, "n": 0.4, "N": 32000, "seeds": 6, "tau_max": 400,
  "observables": ["temperature", "laguerre"] })";

constexpr std::array<Figure, 13> figures = {{
    {1, "temperature against Haff's law", figure_01, four_restitutions},
    {2, "duration of the homogeneous stage", figure_02, four_restitutions},
    {3, "velocity distribution", nullptr, {}},
    {4, "Laguerre coefficients a2, a3, a4", figure_04, one_restitution},
    {5, "a2 against Enskog-Boltzmann theory", figure_05, one_restitution},
    {6, "a2 at short times for several densities", nullptr, {}},
    {7, "a2 against tau/tau_c", nullptr, {}},
    {8, "velocity field", nullptr, {}},
    {9, "velocity correlations", nullptr, {}},
    {10, "scaling of velocity correlations", nullptr, {}},
    {11, "decay rate in the early stage", figure_11, four_restitutions},
    {12, "decay rate for several densities", nullptr, {}},
    {13, "energy above Haff's law", figure_13, four_restitutions},
}};

std::vector<Figure> asked_for(const std::vector<int>& only) {
  if (only.empty()) return {figures.begin(), figures.end()};
  std::vector<Figure> asked;
  for (const int id : only) {
    const auto found = std::ranges::find(figures, id, &Figure::id);
    if (found == figures.end()) {
      throw UnknownFigure(fmt::format("figure {}: there is none; figures are numbered 1 to {}", id,
                                      figures.back().id));
    }
    asked.push_back(*found);
  }
  return asked;
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw std::runtime_error(
        fmt::format("{}: folder cannot be made: {}", folder.string(), error.message()));
  }
}

// Writes tables and pictures to a folder. Without gnuplot it goes on with tables alone.
class Drawer {
 public:
  explicit Drawer(std::filesystem::path folder) : folder_(std::move(folder)) {
    make_folder(folder_);
  }

  // The endings of the files written.
  std::string draw(int id, const Plot& plot) {
    const auto file = [&](const char* ending) {
      return folder_ / fmt::format("figure-{:02}.{}", id, ending);
    };
    write_table(plot, file("csv"));
    if (!missing_.empty()) return "csv";
    try {
      run_gnuplot(gnuplot_script(plot, file("svg"), Format::svg));
      finish_svg(plot, file("svg"));
      run_gnuplot(gnuplot_script(plot, file("png"), Format::png));
    } catch (const GnuplotMissing& missing) {
      missing_ = missing.what();
      return "csv";
    }
    return "csv, svg, png";
  }

  // Why there are no pictures; empty if there are.
  const std::string& missing() const { return missing_; }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
  std::string missing_;
};

}  // namespace

int draw_figures(const schema::Reader& store, const FigureRequest& request, std::ostream& report) {
  const auto asked = asked_for(request.only);
  const Averages averages = read_averages(store);
  Drawer drawer(request.out);
  std::size_t drawn = 0;
  for (const Figure& figure : asked) {
    const std::string head = fmt::format("figure {:>2}  {}: ", figure.id, figure.title);
    if (figure.make == nullptr) {
      fmt::print(report, "{}this version does not draw it\n", head);
      continue;
    }
    const auto plot = figure.make(averages);
    if (!plot) {
      fmt::print(report, "{}the store has no finished jobs for it; plan, for example\n{}\n", head,
                 figure.plan);
      continue;
    }
    const std::string endings = drawer.draw(figure.id, *plot);
    fmt::print(report, "{}{} ({})\n           {}\n", head,
               (drawer.folder() / fmt::format("figure-{:02}", figure.id)).string(), endings,
               plot->caption);
    ++drawn;
  }
  if (!drawer.missing().empty()) fmt::print(report, "{}\n", drawer.missing());
  const bool complete = request.only.empty() ? drawn > 0 : drawn == asked.size();
  return complete && drawer.missing().empty() ? 0 : 1;
}

}  // namespace haff::campaign
