// SPDX-License-Identifier: GPL-3.0-or-later

// The output and the files of `campaign cost`.
#include "campaign/accuracy/cost/cost.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "campaign/accuracy/cost/target.hpp"
#include "support/synthetic_store.hpp"
#include "support/temporary_folder.hpp"

using namespace haff;
using namespace haff::campaign;

namespace {

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("cost: writes a table, a CSV of whole rows, and pictures") {
  const TemporaryFolder folder;
  schema::Store store = schema::Store::in_memory();
  add_finished(store, 0.9, 0.4, 1000, 8, 20);
  add_finished(store, 0.9, 0.4, 4000, 4, 20);
  std::ostringstream report;
  const int exit_code = cost(store, {.out = folder.path() / "cost", .targets = {}}, report);
  CHECK(report.str().find("a2, tau 5 to 15") != std::string::npos);
  CHECK(report.str().find("finite size") != std::string::npos);
  CHECK(report.str().find("The cheapest way to an error") != std::string::npos);
  CHECK(report.str().find("rests on the scatter of 4 runs") != std::string::npos);
  CHECK(report.str().find("Arithmetic: double") != std::string::npos);
  std::istringstream csv(text_of(folder.path() / "cost" / "cost.csv"));
  std::string head, line;
  std::getline(csv, head);
  CHECK(head.ends_with(",memory_bytes"));
  while (std::getline(csv, line)) {
    const auto quote = line.find('"');
    if (quote != std::string::npos)
      line.erase(quote, line.find('"', quote + 1) - quote);  // commas in quotes do not separate
    CAPTURE(line);
    CHECK(std::ranges::count(line, ',') == std::ranges::count(head, ','));
  }
  if (exit_code == 0)  // gnuplot is installed
    CHECK(std::filesystem::file_size(folder.path() / "cost" / "cost-e0.90-n0.40.svg") > 1000);
}

TEST_CASE("cost: advice for a wanted error") {
  const TemporaryFolder folder;
  schema::Store store = schema::Store::in_memory();
  add_finished(store, 0.9, 0.4, 1000, 8, 20);
  std::ostringstream report;
  cost(store, {.out = folder.path(), .targets = {{.measure = Measure::a2, .error = 2e-4}}}, report);
  CHECK(report.str().find("2.0e-04") != std::string::npos);
}

TEST_CASE("cost: a wanted error of a quantity that no run reaches gets an answer") {
  const TemporaryFolder folder;
  schema::Store store = schema::Store::in_memory();
  add_finished(store, 0.9, 0.4, 1000, 8, 20);
  std::ostringstream report;
  cost(
      store,
      {.out = folder.path(),
       .targets = {target_from_text("tau_c=0.5").value(), target_from_text("a2@30:40=1e-3").value(),
                   target_from_text("gamma_ratio@15=1e-3").value()}},
      report);
  CHECK(report.str().find("tau_c: no run reaches it") != std::string::npos);
  CHECK(report.str().find("a2, tau 30 to 40: no run reaches it; plan \"tau_max\": 40") !=
        std::string::npos);
  CHECK(report.str().find("gamma/gamma0, tau 13 to 17") != std::string::npos);
}

TEST_CASE("cost: for an empty store the message says what to plan") {
  const TemporaryFolder folder;
  const schema::Store store = schema::Store::in_memory();
  std::ostringstream report;
  CHECK(cost(store, {.out = folder.path() / "cost", .targets = {}}, report) == 1);
  CHECK(report.str().find("\"seeds\"") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(folder.path() / "cost"));
}

TEST_CASE("cost: gases that differ only in their effects have separate pictures") {
  const TemporaryFolder folder;
  schema::Store store = schema::Store::in_memory();
  for (const char* effects : {"{}", R"({"shuffle":{"every":1.0}})"})
    add_finished(store,
                 {.e = 0.9,
                  .n = 0.4,
                  .particles = 1000,
                  .effects = effects,
                  .observables = {"laguerre", "temperature"}},
                 4, 20);
  std::ostringstream report;
  CHECK(cost(store, {.out = folder.path(), .targets = {}}, report) == 0);
  CHECK(std::filesystem::exists(folder / "cost-e0.90-n0.40.png"));
  CHECK(std::filesystem::exists(folder / "cost-e0.90-n0.40-shuffle-every-1.0.png"));
}
