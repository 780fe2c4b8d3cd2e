// SPDX-License-Identifier: GPL-3.0-or-later

// `campaign report`: the page that it writes, and its messages where it cannot. tests/report tests
// the page in a browser.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "cli/program.hpp"

using namespace haff::tests;

namespace {

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

void plan(const Folder& folder) {
  folder.write("grid.json", R"({"e": 0.8, "n": 0.4, "N": 500, "seeds": 2, "tau_max": 20})");
  REQUIRE(campaign(folder, {"plan", "grid.json"}).exit_code == 0);
}

// A program that was built without npm or a network has no page, and says what to install.
bool has_page() {
  const Folder folder;
  const Outcome outcome = campaign(folder, {"report"});
  if (outcome.err.find("built without") == std::string::npos) return true;
  CHECK(outcome.exit_code == 1);
  CHECK(outcome.err.find("npm") != std::string::npos);
  CHECK(outcome.err.find("campaign figures") != std::string::npos);
  MESSAGE(outcome.err);
  return false;
}

}  // namespace

TEST_CASE("report: the page is one file that needs no network") {
  if (!has_page()) return;
  const Folder folder;
  plan(folder);
  REQUIRE(campaign(folder, {"run"}).exit_code == 0);
  const Outcome outcome = campaign(folder, {"report", "--out", "pages"});
  CAPTURE(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK(outcome.out.find("pages/report.html") != std::string::npos);
  const std::string page = text_of(folder / "pages" / "report.html");
  CHECK(page.starts_with("<!DOCTYPE html>"));
  CHECK(page.ends_with("</html>\n"));
  CHECK(page.find("connect-src 'none'") != std::string::npos);
  CHECK(page.find("{{") == page.find("{{", page.find("<script>")));  // every part is in its place
  for (const char* outside : {" src=", "@import", "url("})
    CHECK(page.substr(0, page.find("<script")).find(outside) == std::string::npos);
}

TEST_CASE("report: the page of a store in which nothing is done") {
  if (!has_page()) return;
  const Folder folder;
  plan(folder);
  CHECK(campaign(folder, {"report"}).exit_code == 0);
  CHECK(std::filesystem::exists(folder / "report" / "report.html"));
}

TEST_CASE("report: a missing store is bad input, and a folder that cannot be made is a failure") {
  if (!has_page()) return;
  const Folder folder;
  CHECK(campaign(folder, {"report"}).exit_code == 2);
  plan(folder);
  folder.write("report", "a file");
  const Outcome outcome = campaign(folder, {"report"});
  CHECK(outcome.exit_code == 1);
  CHECK(outcome.err.find("report") != std::string::npos);
}
