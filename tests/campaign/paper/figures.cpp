// The figures command on stores made from theory: files, words and exit codes.
#include "campaign/paper/figures.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <initializer_list>
#include <sstream>
#include <string>

#include "campaign/paper/figure.hpp"
#include "schema/grid.hpp"
#include "support/synthetic_store.hpp"
#include "support/temporary_folder.hpp"

using namespace haff;
using namespace haff::campaign;

namespace {

schema::Store first_campaign(int seeds = 2) {
  auto store = schema::Store::in_memory();
  add_finished(store, 0.8, 0.4, 2000, seeds, 90);
  add_finished(store, 0.9, 0.4, 2000, seeds, 180);
  add_finished(store, 0.85, 0.2, 2000, seeds, 40);
  add_finished_with_profiles(store, 0.8, 0.4, 3000, 1, 60, 10, {60});
  return store;
}

std::string contents(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

struct Drawn {
  int code;
  std::string report;
};

Drawn draw(const schema::Reader& store, const std::filesystem::path& out,
           std::vector<int> only = {}) {
  std::ostringstream report;
  const int code = draw_figures(store, {.out = out, .only = std::move(only)}, report);
  return {code, report.str()};
}

}  // namespace

TEST_CASE("figures: a small campaign gives tables and pictures of all it can draw") {
  const TemporaryFolder folder;
  const auto drawn = draw(first_campaign(), folder.path() / "made" / "here");
  CHECK(drawn.code == 0);
  for (int id = 1; id <= 13; ++id) {
    const std::string name = "figure-" + std::string(id < 10 ? "0" : "") + std::to_string(id);
    const auto file = folder.path() / "made" / "here" / name;
    CHECK(contents(file.string() + ".csv").starts_with("panel,curve,kind,"));
    CHECK(contents(file.string() + ".svg").find("</svg>") != std::string::npos);
    CHECK(contents(file.string() + ".png").starts_with("\x89PNG"));
  }
  CHECK(drawn.report.find("N = 2 000, mean of 2 realizations. haff synthetic.") !=
        std::string::npos);
}

TEST_CASE("figures: a page shows them all, beside a table of agreement") {
  const TemporaryFolder folder;
  const auto drawn = draw(first_campaign(), folder.path());
  CHECK(drawn.report.find("index.html") != std::string::npos);
  const std::string page = contents(folder.path() / "index.html");
  CHECK(page.find("src=\"figure-01.svg\"") != std::string::npos);
  CHECK(page.find("Figure 13") != std::string::npos);
  CHECK(contents(folder.path() / "agreement.csv").find("\ntau_c,") != std::string::npos);
}

TEST_CASE("figures: one realization is drawn too, without errors") {
  const TemporaryFolder folder;
  const auto drawn = draw(first_campaign(1), folder.path());
  CHECK(drawn.code == 0);
  CHECK(drawn.report.find("one realization") != std::string::npos);
  CHECK(drawn.report.find("standard error") == std::string::npos);
}

TEST_CASE("figures: only those asked for are drawn") {
  const TemporaryFolder folder;
  CHECK(draw(first_campaign(), folder.path(), {2}).code == 0);
  CHECK(std::filesystem::exists(folder.path() / "figure-02.svg"));
  CHECK_FALSE(std::filesystem::exists(folder.path() / "figure-01.svg"));
  CHECK_FALSE(std::filesystem::exists(folder.path() / "index.html"));
}

TEST_CASE("figures: a figure asked for whose data is missing is named, with a grid that gives it") {
  const TemporaryFolder folder;
  auto store = schema::Store::in_memory();
  add_finished(store, 0.95, 0.4, 2000, 1, 20);  // does not reach tau_c
  const auto drawn = draw(store, folder.path(), {1, 2});
  CHECK(drawn.code == 1);
  const auto words = drawn.report.find("figure  2");
  REQUIRE(words != std::string::npos);
  const auto from = drawn.report.find('{', words), to = drawn.report.rfind('}');
  const std::string grid = drawn.report.substr(from, to - from + 1);
  CHECK_NOTHROW(
      schema::parse_grid(grid, "the example", {.bytes = 1e12, .bytes_per_particle = 100}));
}

TEST_CASE("figures: boxes are drawn where they lie on both sides of the critical one") {
  const TemporaryFolder folder;
  auto store = schema::Store::in_memory();
  add_finished(store, 0.8, 0.4, 300, 2, 300, 10);
  add_finished(store, 0.8, 0.4, 450, 2, 300, 10);
  CHECK(draw(store, folder.path(), {15}).code == 1);
  add_finished(store, 0.8, 0.4, 1000, 2, 300, 10);
  const auto drawn = draw(store, folder.path(), {15});
  CHECK(drawn.code == 0);
  CHECK(drawn.report.find("2πξ⊥ = 11.21 σ, N = 563") != std::string::npos);
  CHECK(contents(folder.path() / "figure-15.csv").find("\"(L_c/L)^2, N = 1000\"") !=
        std::string::npos);
}

TEST_CASE("figures: the theory without correlations is the equation's own where it is known") {
  const TemporaryFolder folder;
  auto store = schema::Store::in_memory();
  add_finished(store, 0.9, 0.4, 2000, 1, 180);
  CHECK(draw(store, folder.path(), {4, 5}).code == 0);
  CHECK(contents(folder.path() / "figure-04.csv").find("direct simulation, a4") !=
        std::string::npos);
  const std::string five = contents(folder.path() / "figure-05.csv");
  CHECK(five.find("direct simulation, a2") != std::string::npos);
  CHECK(five.find("first order, a2") != std::string::npos);
}

TEST_CASE("figures: an empty store gives none, and says what to plan") {
  const TemporaryFolder folder;
  const auto drawn = draw(schema::Store::in_memory(), folder.path());
  CHECK(drawn.code == 1);
  CHECK(drawn.report.find("plan, for example") != std::string::npos);
}

TEST_CASE("figures: a number the paper does not have is refused") {
  const TemporaryFolder folder;
  CHECK_THROWS_AS(draw(first_campaign(), folder.path(), {99}), UnknownFigure);
}

namespace {

// What is drawn where `gnuplot` is this shell script; the true one is $gnuplot.
Drawn draw_with(const std::string& script, const std::filesystem::path& out,
                std::vector<int> only = {}) {
  const TemporaryFolder bin;
  const char* set = std::getenv("PATH");
  const std::string path = set != nullptr ? set : "/usr/bin:/bin";
  if (!script.empty()) {
    std::ofstream(bin / "gnuplot") << "#!/bin/sh\nPATH=" << path << "\n" << script << "\n";
    std::filesystem::permissions(bin / "gnuplot", std::filesystem::perms::owner_all);
  }
  ::setenv("PATH", bin.path().c_str(), 1);
  const auto drawn = draw(first_campaign(), out, std::move(only));
  ::setenv("PATH", path.c_str(), 1);
  return drawn;
}

std::size_t count(const std::string& word, const std::string& text) {
  std::size_t found = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++found;
  return found;
}

}  // namespace

TEST_CASE("figures: without gnuplot the tables are written and one message says what to install") {
  const TemporaryFolder folder;
  const auto drawn = draw_with("", folder.path());
  CHECK(drawn.code == 1);
  CHECK(std::filesystem::exists(folder / "figure-01.csv"));
  CHECK(std::filesystem::exists(folder / "index.html"));
  CHECK_FALSE(std::filesystem::exists(folder / "figure-01.svg"));
  CHECK(count("apt-get install gnuplot-nox", drawn.report) == 1);
}

TEST_CASE("figures: a picture that is cut off is not left there, and the rest is drawn") {
  const TemporaryFolder folder;
  const auto drawn = draw_with(
      R"(cat > "$0.in"; grep -q pngcairo "$0.in" && gnuplot -d "$0.in" | head -c 2000 || gnuplot -d "$0.in")",
      folder.path(), {1, 2});
  CHECK(drawn.code == 1);
  CHECK(drawn.report.find("figure-01 (csv, svg)") != std::string::npos);
  CHECK(drawn.report.find("figure-02 (csv, svg)") != std::string::npos);
  CHECK(drawn.report.find("figure-02.png: gnuplot's picture is cut off") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(folder / "figure-01.png"));
  CHECK(contents(folder / "figure-02.svg").find("</svg>") != std::string::npos);
}

TEST_CASE("figures: a gnuplot that draws nothing, and one without pngcairo, are reported") {
  const TemporaryFolder folder;
  const auto nothing = draw_with("cat > /dev/null", folder.path(), {1});
  CHECK(nothing.code == 1);
  CHECK(nothing.report.find("gnuplot has drawn nothing") != std::string::npos);
  const auto no_cairo = draw_with(R"(sed s/pngcairo/pngnone/ | gnuplot -d)", folder.path());
  CHECK(no_cairo.code == 1);
  CHECK(no_cairo.report.find("figure-13 (csv, svg)") != std::string::npos);
  CHECK(no_cairo.report.find("gnuplot failed: ") != std::string::npos);
  CHECK(contents(folder / "index.html").find("figure-13.svg") != std::string::npos);
}

TEST_CASE("figures: a picture of an earlier time does not pass for one that failed") {
  const TemporaryFolder folder;
  CHECK(draw(first_campaign(), folder.path(), {1}).code == 0);
  CHECK(draw_with("exit 1", folder.path(), {1}).code == 1);
  CHECK_FALSE(std::filesystem::exists(folder / "figure-01.png"));
}

TEST_CASE("figures: a damaged field ends figure 8 alone") {
  Averages averages = read_averages(first_campaign());
  REQUIRE(averages.velocity_field);
  auto& field = averages.velocity_field->field;
  CHECK(figure_08(averages));
  for (const int cells : {68, 4, 17, 15, 0, -1, 1 << 30}) {  // 16 in truth
    field.cells = cells;
    CHECK_THROWS_WITH(figure_08(averages), doctest::Contains("damaged"));
  }
  field.cells = 16;
  field.components = 1;
  CHECK_THROWS_WITH(figure_08(averages), doctest::Contains("damaged"));
}

TEST_CASE("figures: a folder that cannot be made is an error that names it") {
  CHECK_THROWS_WITH(draw(first_campaign(), "/proc/nowhere"), doctest::Contains("/proc/nowhere"));
}

TEST_CASE("figure 11: a decay rate belongs to the middle of its interval") {
  auto store = schema::Store::in_memory();
  add_finished(store, 0.8, 0.4, 2000, 1, 20, 2);
  const auto plot = figure_11(read_averages(store));
  REQUIRE(plot);
  const Curve& measured = plot->panels.front().curves.front();
  REQUIRE(measured.source == Source::measured);
  CHECK(measured.x[0] == 1);  // of the sample at tau = 2
  CHECK(measured.x[1] == 4);  // of those at 4 and 6, which are the time from 2 to 6
}

TEST_CASE("figure 13: where E - E_Haff meets E_Haff is tau_c") {
  const auto plot = figure_13(read_averages(first_campaign()));
  REQUIRE(plot);
  const auto& curves = plot->panels.front().curves;
  const Curve& haff = curves[0];    // of e = 0.80
  const Curve& theory = curves[4];  // after two of Haff and two measured
  REQUIRE(theory.source == Source::theory);
  double crossing = 0;
  for (std::size_t i = 1; i < theory.x.size(); ++i) {
    if (theory.y[i] > haff.y[i] && crossing == 0) crossing = theory.x[i];
  }
  // 58.6 from an independent solution, to the spacing of the curve's points.
  CHECK(std::abs(crossing - 58.6) < 0.4);
}

TEST_CASE("captions: gases of the same size and number of realizations are named together") {
  std::vector<MeanSeries> series(3);
  for (auto& each : series) each.n = 0.4;
  series[0] = {.e = 0.80, .n = 0.4, .particles = 32000, .realizations = {2, 2}};
  series[1] = {.e = 0.85, .n = 0.4, .particles = 600000, .realizations = {1}};
  series[2] = {.e = 0.865, .n = 0.4, .particles = 32000, .realizations = {2}};
  CHECK(provenance(series) ==
        "n = 0.40; e = 0.80, 0.865: N = 32 000, mean of 2 realizations; e = 0.85: N = 600 000, one "
        "realization.");
}

TEST_CASE("captions: of densities the restitution is common; what is missing is said") {
  std::vector<MeanSeries> series(2);
  series[0] = {
      .e = 0.85, .n = 0.05, .particles = 1000, .realizations = {3, 3, 2}, .tau = {0, 1, 2}};
  series[1] = {.e = 0.85, .n = 0.4, .particles = 1000, .realizations = {3}, .tau = {0}};
  series[1].missing = 1;
  series[1].code_versions = {"0.1.0 (1a2b)"};
  CHECK(provenance(series) ==
        "e = 0.85; n = 0.40: N = 1 000, mean of 3 realizations (1 planned not done); n = 0.05: N = "
        "1 000, mean of 3 realizations (2 beyond τ = 1). haff 0.1.0 (1a2b).");
}

TEST_CASE("figure 7: smoothed over the paper's windows, against tau/tau_c") {
  const auto plot = figure_07(read_averages(first_campaign()));
  REQUIRE(plot);
  const Curve& curve = plot->panels.front().curves.front();
  CHECK(curve.e == 0.8);
  const auto averages = read_averages(first_campaign());
  const auto chosen = choose_series(averages, 0.4, &MeanSeries::a2);
  const Realization& run = chosen.front().runs.front();
  CHECK(curve.x[10] == doctest::Approx(10 / *run.tau_c));
  CHECK(curve.y[10] == doctest::Approx((run.a2[9] + run.a2[10] + run.a2[11]) / 3));
}

TEST_CASE("figure 14: every shuffled series is a curve of its own") {
  auto store = schema::Store::in_memory();
  for (const char* effects : {"{}", R"({"shuffle":{"every":1.0}})", R"({"shuffle":{"every":5.0}})"})
    add_finished(store,
                 {.e = 0.85,
                  .n = 0.4,
                  .particles = 2000,
                  .effects = effects,
                  .observables = {"laguerre", "temperature"}},
                 3, 40);
  const auto averages = read_averages(store);
  REQUIRE(averages.shuffled.size() == 2);
  const auto plot = figure_14(averages);
  REQUIRE(plot);
  const auto& curves = plot->panels.front().curves;
  REQUIRE(curves.size() == 5);  // with the theory and its first order
  CHECK(curves[0].name == "not shuffled");
  CHECK(curves[1].name == "shuffled every 1");
  CHECK(curves[2].name == "shuffled every 5");
  for (std::size_t k = 0; k < 3; ++k) {
    const MeanSeries& series = k == 0 ? averages.series.front() : averages.shuffled[k - 1];
    CHECK(curves[k].x.front() == 0);
    // A mean of the same three numbers, summed in the same order.
    CHECK(curves[k].y.front() == doctest::Approx(series.a2.value.front()).epsilon(1e-12));
    CHECK(curves[k].error.front() > 0);
    CHECK(std::ranges::is_sorted(curves[k].x));
  }
}
