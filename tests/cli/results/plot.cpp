// SPDX-License-Identifier: GPL-3.0-or-later

// campaign plot: questions to a store that the real program has filled.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "cli/program.hpp"

using namespace haff::tests;

namespace {

void fill(const Folder& folder) {
  folder.write("grid.json", R"({"N": 200, "seeds": 2, "tau_max": 6, "n": 0.2, "equilibrate": 10,
    "grids": [
      {"e": [0.8, 0.9]},
      {"e": 0.9, "effects": [{"roughness": {"beta": [-0.5, 0.5], "q": 0.4}}]},
      {"effects": [{"restitution": {"law": "viscoelastic", "A": 0.1}}]}]})");
  REQUIRE(campaign(folder, {"plan", "grid.json"}).exit_code == 0);
  REQUIRE(campaign(folder, {"run", "--workers", "2"}).exit_code == 0);
}

std::string contents(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("plot: pictures, tables and text, a list, and errors with their exit codes") {
  const Folder folder;
  fill(folder);

  SUBCASE("the quantities of the store are listed") {
    const auto list = campaign(folder, {"plot", "--list"});
    CHECK(list.exit_code == 0);
    for (const char* word : {"rotational_ratio", "gamma_ratio@20", "roughness.beta", "-0.5, 0.5",
                             "restitution.law", "viscoelastic"})
      CHECK(list.out.find(word) != std::string::npos);
    CHECK(list.out.find("largest_cluster") == std::string::npos);
  }
  SUBCASE("without a file the picture is text of 80 columns, and has no colours in a pipe") {
    const auto text = campaign(folder, {"plot", "a2", "--against", "tau", "--by", "e", "--theory"});
    CHECK(text.exit_code == 0);
    CHECK(text.out.find("e = 0.8") != std::string::npos);
    CHECK(text.out.find("─┬─") != std::string::npos);
    CHECK(text.out.find('\x1b') == std::string::npos);
  }
  SUBCASE("the suffix decides the format") {
    for (const char* file : {"p.svg", "p.png", "p.csv"}) {
      const auto drawn = campaign(folder, {"plot", "energy", "--log", "y", "--out", file});
      CHECK(drawn.exit_code == 0);
      CHECK(drawn.out.find(file) == 0);
    }
    CHECK(contents(folder / "p.svg").find("</svg>") != std::string::npos);
    CHECK(contents(folder / "p.png").starts_with("\x89PNG"));
    const std::string table = contents(folder / "p.csv");
    CHECK(table.starts_with("panel,curve,kind,e,n,particles,d,"));
    CHECK(table.find(",roughness.beta,") != std::string::npos);
    CHECK(table.find(",realizations,tau,energy,energy_error\n") != std::string::npos);
    CHECK(campaign(folder, {"plot", "energy", "--out", "p.pdf"}).exit_code == 2);
  }
  SUBCASE("against an effect's parameter, and differences from the gas without the effect") {
    const auto drawn = campaign(folder, {"plot", "rotational_ratio@6", "--against",
                                         "roughness.beta", "--theory", "--out", "p.csv"});
    CHECK(drawn.exit_code == 0);
    CHECK(contents(folder / "p.csv").find("theory") != std::string::npos);
    const auto less = campaign(folder, {"plot", "temperature", "--difference", "roughness=none",
                                        "--where", "e = 0.9", "--out", "d.csv"});
    CHECK(less.exit_code == 0);
    CHECK(contents(folder / "d.csv").find("beta = 0.5") != std::string::npos);
  }
  SUBCASE("an unknown column, wrong SQL, and no data to draw") {
    const auto unknown = campaign(folder, {"plot", "temprature"});
    CHECK(unknown.exit_code == 2);
    CHECK(unknown.err.find("did you mean \"temperature\"?") != std::string::npos);
    const auto sql = campaign(folder, {"plot", "a2", "--where", "e = = 1"});
    CHECK(sql.exit_code == 2);
    CHECK(sql.err.find("SQL: near \"=\": syntax error") != std::string::npos);
    const auto writes = campaign(folder, {"plot", "a2", "--where", "1); DELETE FROM jobs; --"});
    CHECK(writes.exit_code == 2);
    const auto nothing = campaign(folder, {"plot", "a2", "--where", "e = 0.5", "--out", "n.svg"});
    CHECK(nothing.exit_code == 1);
    CHECK(nothing.err.find("nothing to draw") != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(folder / "n.svg"));
    CHECK(campaign(folder, {"plot"}).exit_code == 2);
    CHECK(campaign(folder, {"plot", "a2", "--log", "z"}).exit_code == 2);
    CHECK(campaign(folder, {"plot", "a2", "--difference", "e"}).exit_code == 2);
  }
  SUBCASE("text of the question does not become a command of gnuplot") {
    const auto drawn = campaign(
        folder,
        {"plot", "a2 + 0*length('\n`touch pwned`\nsystem \"touch pwned\"')", "--out", "e.png"});
    CHECK(drawn.exit_code == 0);
    CHECK_FALSE(std::filesystem::exists(folder / "pwned"));
  }
}
