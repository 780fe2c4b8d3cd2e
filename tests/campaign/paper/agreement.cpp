// The table of agreement on stores made from theory, which they must agree with.
#include "campaign/paper/agreement.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "campaign/paper/page.hpp"
#include "support/synthetic_store.hpp"
#include "support/temporary_folder.hpp"

using namespace haff;
using namespace haff::campaign;

namespace {

std::vector<Comparison> of_theory() {
  auto store = schema::Store::create(":memory:");
  add_finished(store, 0.80, 0.4, 100'000, 3, 180);
  add_finished(store, 0.85, 0.4, 100'000, 3, 100);
  add_finished(store, 0.90, 0.4, 100'000, 3, 160);
  add_finished(store, 0.85, 0.2, 100'000, 3, 100);
  return agreement(read_averages(store));
}

std::vector<Comparison> rows_of(const std::string& claim, const std::vector<Comparison>& table) {
  std::vector<Comparison> found;
  std::ranges::copy_if(table, std::back_inserter(found),
                       [&](const Comparison& row) { return row.claim == claim; });
  return found;
}

std::string contents(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("agreement: a gas that obeys theory agrees with it") {
  const auto table = of_theory();
  for (const char* claim : {"tau_c", "energy", "decay", "order"}) {
    CAPTURE(claim);
    const auto rows = rows_of(claim, table);
    CHECK_FALSE(rows.empty());
    for (const auto& row : rows) CHECK(row.holds == true);
  }
  CHECK(rows_of("tau_c", table).size() == 3);  // where the paper has one
  CHECK(rows_of("decay", table).size() == 4);
  for (const auto& row : rows_of("cutoff", table)) {
    CHECK(row.value == doctest::Approx(0.30).epsilon(0.05));
  }
}

TEST_CASE("agreement: a gas that does not is said not to") {
  // Twice as hot as it should be from the middle on.
  Averages averages;
  auto store = schema::Store::create(":memory:");
  add_finished(store, 0.80, 0.4, 100'000, 2, 90);
  averages = read_averages(store);
  for (std::size_t i = 20; i < averages.series[0].tau.size(); ++i) {
    averages.series[0].temperature.value[i] *= 2;
    for (auto& run : averages.series[0].runs) run.temperature[i] *= 2;
  }
  const auto table = agreement(averages);
  CHECK(rows_of("energy", table).front().holds == false);
  CHECK(rows_of("decay", table).front().holds == false);
}

TEST_CASE("agreement: no data, no claims") {
  CHECK(agreement(read_averages(schema::Store::create(":memory:"))).empty());
}

TEST_CASE("agreement: a table has a row a claim, and nothing where there is nothing") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "agreement.csv";
  write_agreement({{.claim = "order", .quantity = "a, b", .value = 0.1, .holds = false}}, file);
  CHECK(contents(file) ==
        "claim,quantity,e,n,value,standard_error,reference,source,criterion,holds,note\n"
        "order,\"a, b\",,,0.10000000000000001,,,\"\",\"\",no,\"\"\n");
}

TEST_CASE("page: what is drawn is shown, what is not is named, and text is escaped") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "index.html";
  write_page({{.id = 1, .title = "first", .picture = "figure-01.svg", .caption = "a < b"},
              {.id = 3, .title = "third", .caption = "not drawn", .published = "P"}},
             {{.claim = "x", .quantity = "|a| > |b|", .holds = true}}, file);
  const std::string page = contents(file);
  CHECK(page.find("src=\"figure-01.svg\"") != std::string::npos);
  CHECK(page.find("a &lt; b") != std::string::npos);
  CHECK(page.find("|a| &gt; |b|") != std::string::npos);
  CHECK(page.find("not drawn") != std::string::npos);
  CHECK(page.find("1 of 1 within") != std::string::npos);
  CHECK(page.find("http") == std::string::npos);  // nothing from elsewhere
}
