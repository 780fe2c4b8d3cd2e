// SPDX-License-Identifier: GPL-3.0-or-later

// Plots as tables and as scripts.
#include "campaign/plot/plot.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "campaign/plot/colours.hpp"
#include "campaign/plot/script.hpp"
#include "campaign/plot/table.hpp"
#include "support/temporary_folder.hpp"

using namespace haff::campaign;

namespace {

Plot two_curves() {
  Curve measured{.name = "e = 0.80", .e = 0.8, .n = 0.4, .particles = 1000};
  measured.x = {0, 1};
  measured.y = {1.0 / 3, 0.25};
  measured.error = {NAN, 0.5};
  measured.realizations = {1, 2};
  Curve theory{.name = "Haff", .source = Source::theory, .x = {0, 1}, .y = {1, 0.1}};
  return {.panels = {{.x = {.column = "tau"},
                      .y = {.column = "temperature"},
                      .curves = {measured, theory}}},
          .caption = "n = 0.40; N = 32 000."};
}

std::string table_of(const Plot& plot) {
  const haff::TemporaryFolder folder;
  write_table(plot, folder.path() / "t.csv");
  std::ostringstream text;
  text << std::ifstream(folder.path() / "t.csv").rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE(
    "plot: a table has a head, a row per point, 17 digits and empty fields for missing values") {
  CHECK(table_of(two_curves()) ==
        "panel,curve,kind,e,n,particles,realizations,tau,temperature,temperature_error\n"
        "main,e = 0.80,measured,0.80000000000000004,0.40000000000000002,1000,1,0,"
        "0.33333333333333331,\n"
        "main,e = 0.80,measured,0.80000000000000004,0.40000000000000002,1000,2,1,0.25,0.5\n"
        "main,Haff,theory,,,,,0,1,\n"
        "main,Haff,theory,,,,,1,0.10000000000000001,\n");
}

TEST_CASE("plot: a table that cannot be written is an error that names it") {
  CHECK_THROWS_WITH(write_table(two_curves(), "/nowhere/t.csv"),
                    doctest::Contains("/nowhere/t.csv"));
}

TEST_CASE("plot: a script draws every curve, errors only where there are some") {
  Plot plot = two_curves();
  CHECK(gnuplot_script(plot, PictureFormat::svg).find("filledcurves") != std::string::npos);
  plot.panels[0].curves[0].error.clear();
  const std::string bare = gnuplot_script(plot, PictureFormat::svg);
  CHECK(bare.find("filledcurves") == std::string::npos);
  CHECK(bare.find("$curve0 using 1:2 with lines") != std::string::npos);
  CHECK(bare.find("$curve1 using 1:2 with lines") != std::string::npos);
}

TEST_CASE("plot: logarithmic axes leave out values that they cannot show") {
  Plot plot = two_curves();
  plot.panels[0].y.logarithmic = true;
  plot.panels[0].curves[0].y = {-1, 0.25};
  plot.panels[0].curves[0].error = {0.1, 0.5};  // reaches below zero
  const std::string script = gnuplot_script(plot, PictureFormat::png);
  CHECK(script.find("\n0 -1 ") == std::string::npos);
  CHECK(script.find("\n1 0.25 0.00025 0.75\n") != std::string::npos);
}

TEST_CASE("plot: a caption cannot become a command") {
  Plot plot = two_curves();
  plot.caption = "x\nEND\nsystem \"touch pwned\"\n#";
  const std::string script = gnuplot_script(plot, PictureFormat::png);
  CHECK(script.find("\nsystem") == std::string::npos);
  CHECK(script.find("\nEND\nsystem") == std::string::npos);
  // The caption is in the block of data; gnuplot itself reads a doubled backslash as one.
  CHECK(script.find("\tx\\\\x0aEND\\\\x0asystem") != std::string::npos);
}

TEST_CASE("plot: symbols are thinned in the picture, not in the table") {
  Plot plot;
  Curve curve{.name = "many"};
  for (int i = 0; i < 1000; ++i) {
    curve.x.push_back(i);
    curve.y.push_back(i);
  }
  curve.look = Look::symbols;
  plot.panels = {{.x = {.column = "x"}, .y = {.column = "y"}, .curves = {curve}}};
  const std::string script = gnuplot_script(plot, PictureFormat::png);
  CHECK(std::count(script.begin(), script.end(), '\n') < 100);
  const std::string table = table_of(plot);
  CHECK(std::count(table.begin(), table.end(), '\n') == 1001);
}

TEST_CASE("plot: the range of y includes error bars") {
  Curve curve;
  curve.x = {0, 1, 2};
  curve.y = {1, 2, NAN};
  curve.error = {NAN, 0.5, 1};
  const Range range = y_range({curve});
  CHECK(range.low == 1);
  CHECK(range.high == 2.5);
}

TEST_CASE("plot: no two curves share a colour") {
  for (const std::size_t of : {1u, 2u, 4u, 6u, 7u, 9u, 20u}) {
    std::set<std::string> colours;
    for (std::size_t place = 0; place < of; ++place) colours.insert(colour(place, of));
    CHECK(colours.size() == of);
  }
}

TEST_CASE("plot: further parameters of curves are columns of the table") {
  Plot plot = two_curves();
  plot.panels[0].curves[0].parameters = {{"d", "3"}, {"restitution.law", "a, b"}};
  const std::string table = table_of(plot);
  CHECK(table.find(",particles,d,restitution.law,realizations,") != std::string::npos);
  CHECK(table.find(",1000,3,\"a, b\",1,0,") != std::string::npos);
  CHECK(table.find("main,Haff,theory,,,,,,,0,1,") != std::string::npos);
}

TEST_CASE("plot: a scale of tones reaches from end to end of its values") {
  const ToneScale linear{.low = 1, .high = 3};
  CHECK(linear.tone(1) == shade(0, 1000));
  CHECK(linear.tone(3) == shade(999, 1000));
  CHECK(linear.tone(2) == shade(499, 1000));
  const ToneScale logarithmic{.low = 1, .high = 100, .logarithmic = true};
  CHECK(logarithmic.tone(10) == linear.tone(2));
}
