// SPDX-License-Identifier: GPL-3.0-or-later

// The figures command on stores made from theory: files, words and exit codes.
#include "campaign/figures/figures.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <initializer_list>
#include <sstream>
#include <string>

#include "campaign/paper/figure.hpp"
#include "schema/grid/grid.hpp"
#include "support/synthetic_store.hpp"
#include "support/temporary_folder.hpp"

using namespace haff;
using namespace haff::campaign;

namespace {

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

TEST_CASE(
    "figures: a small campaign gives tables and pictures of all that it can draw, and a page") {
  const TemporaryFolder folder;
  const auto made = folder.path() / "made" / "here";
  const auto drawn = draw(first_campaign(), made);
  CHECK(drawn.code == 0);
  for (int id = 1; id <= 13; ++id) {
    const std::string name = "figure-" + std::string(id < 10 ? "0" : "") + std::to_string(id);
    const auto file = made / name;
    CHECK(contents(file.string() + ".csv").starts_with("panel,curve,kind,"));
    CHECK(contents(file.string() + ".svg").find("</svg>") != std::string::npos);
    CHECK(contents(file.string() + ".png").starts_with("\x89PNG"));
  }
  CHECK(drawn.report.find("N = 2 000, mean of 2 realizations. haff synthetic.") !=
        std::string::npos);

  // The page shows all of them, and a table of agreement.
  CHECK(drawn.report.find("index.html") != std::string::npos);
  const std::string page = contents(made / "index.html");
  CHECK(page.find("src=\"figure-01.svg\"") != std::string::npos);
  CHECK(page.find("Figure 13") != std::string::npos);
  CHECK(contents(made / "agreement.csv").find("\ntau_c,") != std::string::npos);
}

TEST_CASE("figures: a single realization is drawn without errors") {
  const TemporaryFolder folder;
  const auto drawn = draw(first_campaign(1), folder.path());
  CHECK(drawn.code == 0);
  CHECK(drawn.report.find("one realization") != std::string::npos);
  CHECK(drawn.report.find("standard error") == std::string::npos);
}

TEST_CASE("figures: only the requested ones are drawn") {
  const TemporaryFolder folder;
  CHECK(draw(first_campaign(), folder.path(), {2}).code == 0);
  CHECK(std::filesystem::exists(folder.path() / "figure-02.svg"));
  CHECK_FALSE(std::filesystem::exists(folder.path() / "figure-01.svg"));
  CHECK_FALSE(std::filesystem::exists(folder.path() / "index.html"));
}

TEST_CASE("figures: a requested figure without data is named, with a grid that gives the data") {
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

TEST_CASE("figures: boxes are drawn if some are smaller and some larger than the critical one") {
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

TEST_CASE(
    "figures: the theory without correlations is the table of direct simulations where it has "
    "one") {
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

TEST_CASE("figures: any store has figures of its own, with a curve for each gas") {
  const TemporaryFolder folder;
  auto store = schema::Store::in_memory();
  add_finished(
      store,
      {.d = 2, .e = 0.9, .n = 0.3, .particles = 500, .observables = {"laguerre", "temperature"}}, 2,
      20);
  const auto drawn = draw(store, folder.path());
  CHECK(drawn.code == 0);
  for (const char* name : {"gas-energy", "gas-a2", "gas-gamma"})
    for (const char* ending : {".csv", ".svg", ".png"})
      CHECK(std::filesystem::exists(folder.path() / (std::string(name) + ending)));
  CHECK_FALSE(std::filesystem::exists(folder.path() / "gas-species.svg"));
  CHECK_FALSE(std::filesystem::exists(folder.path() / "figure-01.svg"));
  CHECK(drawn.report.find("figures --only 1") != std::string::npos);
  const std::string page = contents(folder.path() / "index.html");
  CHECK(page.find("src=\"gas-energy.svg\"") != std::string::npos);
  CHECK(page.find("Agreement") == std::string::npos);
}

TEST_CASE("figures: a general figure is asked for by its name") {
  const TemporaryFolder folder;
  std::ostringstream report;
  const auto store = first_campaign();
  CHECK(draw_figures(store, {.out = folder.path(), .only = {1}, .gases = {"energy"}}, report) == 0);
  CHECK(std::filesystem::exists(folder.path() / "gas-energy.csv"));
  CHECK(draw_figures(store, {.out = folder.path(), .gases = {"species"}}, report) == 1);
  CHECK_THROWS_WITH_AS(draw_figures(store, {.out = folder.path(), .gases = {"energie"}}, report),
                       doctest::Contains("energy, gamma"), UnknownFigure);
}

TEST_CASE("figures: older files that this store does not make are marked") {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "figure-08.svg") << "<svg/>";
  auto store = schema::Store::in_memory();
  add_finished(store, 0.8, 0.4, 500, 2, 20);
  const auto drawn = draw(store, folder.path());
  CHECK(drawn.report.find("Of an earlier run, not of this store: figure-08.svg") !=
        std::string::npos);
  CHECK(contents(folder.path() / "index.html").find("not of this store: figure-08.svg") !=
        std::string::npos);
  CHECK(contents(folder.path() / "index.html").find("src=\"figure-08.svg\"") == std::string::npos);
}

TEST_CASE("figures: an empty store gives none, and the message says what to plan") {
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

// Draws figures with this shell script as `gnuplot`; the real program is $gnuplot.
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

TEST_CASE("figures: an incomplete picture is removed, and the rest is drawn") {
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

TEST_CASE("figures: an old picture is not taken for one that failed") {
  const TemporaryFolder folder;
  CHECK(draw(first_campaign(), folder.path(), {1}).code == 0);
  CHECK(draw_with("exit 1", folder.path(), {1}).code == 1);
  CHECK_FALSE(std::filesystem::exists(folder / "figure-01.png"));
}

TEST_CASE("figures: a folder that cannot be made is an error that names it") {
  CHECK_THROWS_WITH(draw(first_campaign(), "/proc/nowhere"), doctest::Contains("/proc/nowhere"));
}
