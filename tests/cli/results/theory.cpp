// SPDX-License-Identifier: GPL-3.0-or-later

// `campaign theory`: curves by name, in columns, without a store.
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "cli/program.hpp"

using namespace haff::tests;

namespace {

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> all;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) all.push_back(line);
  return all;
}

// The columns of a line of CSV without quotes.
std::vector<double> numbers(const std::string& line) {
  std::vector<double> all;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) all.push_back(std::stod(cell));
  return all;
}

}  // namespace

TEST_CASE("theory: a2 in csv, as in the help") {
  const Folder folder;
  const auto done = campaign(
      folder, {"theory", "a2", "--d", "3", "--e", "0.85", "--tau", "0:40:1", "--format", "csv"});
  CHECK(done.exit_code == 0);
  const auto rows = lines(done.out);
  REQUIRE(rows.size() == 42);
  CHECK(rows[0] == "tau,a2_second_order,a2_dsmc,a2_dsmc_se");
  const auto last = numbers(rows[41]);
  REQUIRE(last.size() == 4);
  CHECK(last[0] == 40);
  CHECK(last[1] == doctest::Approx(-0.0153).epsilon(0.005));  // -A/B
  CHECK(std::abs(last[2] + 0.01688) < 4 * (last[3] + 7e-5));  // the solution of the equation
  CHECK_FALSE(std::filesystem::exists(folder.store()));
}

TEST_CASE("theory: every curve of the list is printed") {
  const Folder folder;
  const auto list = lines(campaign(folder, {"theory", "--list"}).out);
  REQUIRE(list.size() > 10);
  for (std::size_t k = 2; k < list.size(); ++k) {
    const std::string name = list[k].substr(0, list[k].find(' '));
    CAPTURE(name);
    const std::string effects =
        name.starts_with("rotational") ? R"({"roughness": {"beta": 0.5, "q": 0.5}})"
        : name == "species_ratio"
            ? R"({"mixture": {"fraction": 0.5, "diameter_ratio": 1, "mass_ratio": 0.5}})"
            : "{}";
    const auto done = campaign(folder, {"theory", name, "--d", "2", "--e", "0.9", "--format", "csv",
                                        "--effects", effects});
    CHECK(done.exit_code == 0);
    const auto rows = lines(done.out);
    REQUIRE(rows.size() >= 2);
    CHECK(numbers(rows[1]).size() == numbers(rows.back()).size());
  }
}

TEST_CASE("theory: tau_c of the paper's four e") {
  const Folder folder;
  const auto rows = lines(
      campaign(folder, {"theory", "tau_c", "--e", "0.8,0.85,0.9,0.95", "--format", "csv"}).out);
  REQUIRE(rows.size() == 5);
  const double known[] = {58.6, 82.5, 133.9, 303.9};
  for (std::size_t k = 0; k < 4; ++k)
    CHECK(numbers(rows[k + 1])[1] == doctest::Approx(known[k]).epsilon(0.002));
}

TEST_CASE("theory: other e and other laws are computed, with the same result each time") {
  const Folder folder;
  const std::vector<std::string> other = {"theory",         "a2",  "--e",         "0.77",
                                          "--tau",          "0,2", "--particles", "1000",
                                          "--realizations", "3",   "--format",    "json"};
  const auto once = campaign(folder, other);
  CHECK(once.exit_code == 0);
  CHECK(once.out == campaign(folder, other).out);
  const auto soft = campaign(
      folder, {"theory", "temperature", "--tau", "0:2:1", "--particles", "1000", "--realizations",
               "3", "--effects", R"({"restitution": {"law": "viscoelastic", "A": 0.05}})"});
  CHECK(soft.exit_code == 0);
  CHECK(soft.out.find("temperature_dsmc_se") != std::string::npos);
}

TEST_CASE("theory: a word that is not understood is named, with exit code 2") {
  const Folder folder;
  const auto complaint = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "theory");
    const auto done = campaign(folder, arguments);
    CHECK(done.exit_code == 2);
    CHECK(done.out.empty());
    return done.err;
  };
  CHECK(complaint({"a7"}).find("a7") != std::string::npos);
  CHECK(complaint({}).find("--list") != std::string::npos);
  CHECK(complaint({"a2", "--tau", "0:1"}).find("FROM:TO:STEP") != std::string::npos);
  CHECK(complaint({"a2", "--e", "0.8,0.9"}).find("one --e") != std::string::npos);
  CHECK(complaint({"a2", "--e", "1.2"}).find("1.2") != std::string::npos);
  CHECK(complaint({"G_parallel", "--e", "1"}).find("e must be below 1") != std::string::npos);
  CHECK(
      complaint({"a2", "--effects", R"({"roughness": {"beta": 0, "q": 0.4}})"}).find("roughness") !=
      std::string::npos);
  CHECK(complaint({"species_ratio"}).find("is of mixtures") != std::string::npos);
  CHECK(complaint({"a2", "--effects", R"({"restitution": {"law": "glue"}})"}).find("glue") !=
        std::string::npos);
}
