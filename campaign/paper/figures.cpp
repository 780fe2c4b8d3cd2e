#include "campaign/paper/figures.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>
#include <variant>

#include "campaign/base/command_text.hpp"
#include "campaign/base/output_files.hpp"
#include "campaign/base/printable.hpp"
#include "campaign/paper/agreement.hpp"
#include "campaign/paper/figure.hpp"
#include "campaign/paper/page.hpp"
#include "campaign/plot/picture.hpp"
#include "campaign/plot/table.hpp"
#include "campaign/results/mixed_physics.hpp"

namespace haff::campaign {
namespace {

struct Figure {
  int id;
  std::string_view title;
  std::optional<Plot> (*make)(const Averages&);
  std::string_view plan;       // a grid that gives its data
  std::string_view published;  // what the paper shows there
};

constexpr std::string_view four_restitutions =
    R"({ "e": [0.80, 0.85, 0.90, 0.95], "n": 0.4, "N": 32000, "seeds": 3,
  "tau_max": {"0.80": 180, "0.85": 250, "0.90": 400, "0.95": 470},
  "observables": ["temperature", "laguerre"] })";
constexpr std::string_view one_restitution =
    R"({ "e": 0.90, "n": 0.4, "N": 32000, "seeds": 6, "tau_max": 400,
  "observables": ["temperature", "laguerre"] })";

constexpr std::string_view shuffled =
    R"({ "e": 0.85, "n": 0.4, "N": 32000, "seeds": 4, "tau_max": 100,
  "effects": [{}, {"shuffle": {"every": 1}}] })";
constexpr std::string_view several_densities =
    R"({ "e": 0.85, "n": [0.05, 0.1, 0.2, 0.4, 0.5], "N": 32000, "seeds": 3, "tau_max": 90,
  "observables": ["temperature", "laguerre"] })";

constexpr std::string_view boxes =
    R"({ "e": 0.80, "n": 0.4, "N": [300, 450, 563, 700, 1000], "seeds": 16, "tau_max": 400,
  "sample_every": 10 })";

constexpr std::string_view distribution =
    R"({ "e": 0.80, "n": 0.4, "N": 32000, "seeds": 3, "tau_max": 180, "profiles_every": 10,
  "observables": ["temperature", "laguerre", "distribution"] })";
constexpr std::string_view correlations =
    R"({ "e": 0.80, "n": 0.4, "N": 256000, "seeds": 1, "tau_max": 60, "profiles_every": 10,
  "fields_at": 60, "observables": ["temperature", "laguerre", "correlations", "fields"] })";

constexpr std::array<Figure, 15> figures = {{
    {1, "temperature against Haff's law", figure_01, four_restitutions,
     "Haff's law, then a slower decay from τ_c on; late in the clustering stage roughly "
     "T ~ τ^−3 to τ^−4, strongly sample dependent."},
    {2, "duration of the homogeneous stage", figure_02, four_restitutions,
     "τ_c = 58, 82, 134, 309 for e = 0.80, 0.85, 0.90, 0.95."},
    {3, "velocity distribution", figure_03, distribution,
     "close to exp(−c²) throughout the homogeneous stage."},
    {4, "Laguerre coefficients a₂, a₃, a₄", figure_04, one_restitution,
     "|a₂| > |a₃| > |a₄|; all return towards zero before τ_c (mean of 3)."},
    {5, "a₂ against Enskog–Boltzmann theory", figure_05, one_restitution,
     "a₂ follows the theory until close to the value that this settles to, then turns back (mean "
     "of "
     "3, inset of 6)."},
    {6, "a₂ at short times for several densities", figure_06, several_densities,
     "the return of a₂ is slower at low n (densities not listed in the text)."},
    {7, "a₂ against τ/τ_c", figure_07, four_restitutions,
     "small until τ_c, then large and different in every sample; smoothed over Δτ = 3, 3, 5, 7."},
    {8, "velocity field", figure_08, correlations,
     "vortices much larger than a cell at τ = 60 (N = 1 000 000)."},
    {9, "velocity correlations", figure_09, correlations,
     "G∥ and G⊥ at τ = 50 beside incompressible theory (N = 1 000 000)."},
    {10, "scaling of velocity correlations", figure_10, correlations,
     "G τ^(d/2) against r/√τ falls on one curve for 20 ≤ τ ≤ 60 (N = 1 000 000)."},
    {11, "decay rate in the early stage", figure_11, four_restitutions,
     "γ < γ₀ from the start, by far more than Enskog–Boltzmann theory has it; b = 0.30 fits all "
     "e."},
    {12, "decay rate for several densities", figure_12, several_densities,
     "the same b = 0.30 fits all n."},
    {13, "energy above Haff's law", figure_13, four_restitutions,
     "the energy equation with b = 0.30 until τ_c, where E − E_Haff meets E_Haff."},
    {14, "shuffled against not", figure_14, shuffled,
     "not drawn there, but argued with: without correlations a₂ keeps the value that it first "
     "settles to."},
    {15, "boxes below and above the smallest that holds a vortex", figure_15, boxes,
     "not of the paper: hydrodynamics says that γ/γ₀ stays constant below L_c = 2πξ⊥ and tends to "
     "(L_c/L)² above."},
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

// The paper's gas is one of spheres.
void mention_disks(const schema::Reader& store, std::ostream& report) {
  auto rows =
      store.query("SELECT count(*) FROM jobs WHERE kind = 'cooling' AND d = 2 AND status = 'done'");
  const auto disks = std::get<std::int64_t>(rows.next().value()[0]);
  if (disks == 0) return;
  fmt::print(report,
             "The figures are the paper's, of d = 3; {} finished job{} of disks (d = 2) {} in none "
             "of them. Ask for these with: {}\n",
             disks, disks == 1 ? "" : "s", disks == 1 ? "is" : "are",
             command_text("query \"SELECT * FROM mean_series WHERE d = 2\"", store.path()));
}

// The plot, or why there is none.
struct Attempt {
  std::optional<Plot> plot;
  std::string error = {};  // empty: the store lacks its data
};

Attempt attempt(const Figure& figure, const Averages& averages) {
  try {
    return {figure.make(averages)};
  } catch (const std::exception& error) {
    return {std::nullopt, printable(error.what())};
  }
}

}  // namespace

int draw_figures(const schema::Reader& store, const FigureRequest& request, std::ostream& report) {
  const auto asked = asked_for(request.only);
  const Averages averages = read_averages(store);
  for (const std::string& sentence : mixed_physics(store))
    fmt::print(report, "Note: {}\n", sentence);
  make_folder(request.out);
  OutputFiles files;
  std::vector<FigureEntry> entries;
  std::size_t drawn = 0;
  bool failed = false;
  for (const Figure& figure : asked) {
    const std::string head = fmt::format("figure {:>2}  {}: ", figure.id, figure.title);
    const auto stem = request.out / fmt::format("figure-{:02}", figure.id);
    entries.push_back({.id = figure.id,
                       .title = std::string(figure.title),
                       .caption = "not drawn: the store has no finished jobs for it",
                       .published = std::string(figure.published)});
    FigureEntry& entry = entries.back();
    const auto [plot, error] = attempt(figure, averages);
    if (!error.empty()) {
      entry.caption = "not drawn: " + error;
      fmt::print(report, "{}cannot be drawn: {}\n", head, error);
      failed = true;
    }
    if (!plot && error.empty())
      fmt::print(report, "{}the store has no finished jobs for it; plan, for example\n{}\n", head,
                 figure.plan);
    if (!plot) continue;
    const std::size_t before = files.written().size();
    files.attempt(stem.string() + ".csv",
                  [&plot = plot](const auto& file) { write_table(*plot, file); });
    draw_both(*plot, stem, files);
    entry.caption = printable(plot->caption);
    std::vector<std::string> endings;
    for (std::size_t i = before; i < files.written().size(); ++i) {
      endings.push_back(files.written()[i].extension().string().substr(1));
      if (endings.back() != "csv" && entry.picture.empty())
        entry.picture = files.written()[i].filename().string();
    }
    fmt::print(report, "{}{} ({})\n           {}\n", head, stem.string(),
               endings.empty() ? "nothing written" : fmt::format("{}", fmt::join(endings, ", ")),
               entry.caption);
    ++drawn;
  }
  if (request.only.empty() && drawn > 0) {
    const auto table = agreement(averages);
    files.attempt(request.out / "agreement.csv",
                  [&](const auto& file) { write_agreement(table, file); });
    if (files.attempt(request.out / "index.html",
                      [&](const auto& file) { write_page(entries, table, file); }))
      fmt::print(report, "all of them, beside paper and theory: {}\n",
                 (request.out / "index.html").string());
  }
  files.print_missing(report);
  mention_disks(store, report);
  const bool complete = request.only.empty() ? drawn > 0 : drawn == asked.size();
  return complete && !failed && files.is_complete() ? 0 : 1;
}

}  // namespace haff::campaign
