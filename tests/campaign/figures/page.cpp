// SPDX-License-Identifier: GPL-3.0-or-later

// The page of all figures.
#include "campaign/figures/page.hpp"

#include <doctest/doctest.h>

#include <fstream>
#include <sstream>

#include "support/temporary_folder.hpp"

using namespace haff;
using namespace haff::campaign;

namespace {

std::string written(const Page& page) {
  const TemporaryFolder folder;
  write_page(page, folder.path() / "index.html");
  std::ostringstream text;
  text << std::ifstream(folder.path() / "index.html").rdbuf();
  return text.str();
}

std::size_t count(const std::string& word, const std::string& text) {
  std::size_t found = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++found;
  return found;
}

}  // namespace

TEST_CASE("page: drawn figures are shown, others are named, and text is escaped") {
  const std::string page = written(
      {.paper = {{.name = "figure-01",
                  .title = "Figure 1: first",
                  .picture = "figure-01.svg",
                  .table = "figure-01.csv",
                  .caption = "a < b"},
                 {.name = "figure-03", .title = "third", .caption = "not drawn", .published = "P"}},
       .lacking = {"2 (second)"},
       .agreement = {{.claim = "x", .quantity = "|a| > |b|", .holds = true}}});
  CHECK(page.find("src=\"figure-01.svg\"") != std::string::npos);
  CHECK(page.find("href=\"figure-01.csv\"") != std::string::npos);
  CHECK(page.find("a &lt; b") != std::string::npos);
  CHECK(page.find("|a| &gt; |b|") != std::string::npos);
  CHECK(page.find("not drawn") != std::string::npos);
  CHECK(page.find("no finished jobs for them: 2 (second)") != std::string::npos);
  CHECK(page.find("1 of 1 claims hold") != std::string::npos);
  CHECK(page.find("All gases") == std::string::npos);
  CHECK(page.find("http") == std::string::npos);  // nothing is loaded from elsewhere
}

TEST_CASE("page: a caption appears once, beside an SVG or within a PNG") {
  const auto shown = [](const char* picture) {
    return written({.gases = {{.name = "gas-a2",
                               .title = "a2",
                               .picture = picture,
                               .caption = "means of 3 realizations"}}});
  };
  CHECK(count("means of 3 realizations", shown("gas-a2.svg")) == 1);
  CHECK(count("means of 3 realizations", shown("gas-a2.png")) == 0);
}

TEST_CASE("page: a broad picture has a row of its own") {
  const auto shown = [](int width) {
    return written({.gases = {{.name = "gas-a2", .picture = "gas-a2.svg", .width = width}}});
  };
  CHECK(count("class=\"broad\"", shown(1160)) == 1);
  CHECK(count("class=\"broad\"", shown(640)) == 0);
  // On a narrow screen it shrinks to fit, so that nothing is cut off.
  CHECK(count("style=\"min-width", shown(1160)) == 0);
}

TEST_CASE("page: figures of an earlier run are marked") {
  const std::string page = written({.from_before = {"figure-08.svg"}});
  CHECK(page.find("from an earlier run, and not of this store: figure-08.svg") !=
        std::string::npos);
}
