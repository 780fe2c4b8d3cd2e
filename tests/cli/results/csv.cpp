// SPDX-License-Identifier: GPL-3.0-or-later

// Every CSV file that the program writes, as other readers read it: Python's csv module, and
// pandas where it is installed.
#include <doctest/doctest.h>

#include <string>

#include "cli/program.hpp"

using namespace haff::tests;

namespace {

// Prints the number of files read. Each must have rows, all with as many fields as the first.
constexpr const char* check = R"PY(
import csv, glob, sys

names = sorted(name for pattern in sys.argv[1:] for name in glob.glob(pattern))
for name in names:
    with open(name, newline="", encoding="utf-8") as file:
        head, *rows = csv.reader(file, strict=True)
    assert rows, name + " has no rows"
    assert len(set(head)) == len(head), name + " names a column twice"
    for number, row in enumerate(rows, 2):
        assert len(row) == len(head), f"{name}: row {number} has {len(row)} fields, not {len(head)}"
    try:
        import pandas
    except ImportError:
        continue
    table = pandas.read_csv(name)
    assert list(table.columns) == head and len(table) == len(rows), name + ", read by pandas"
print(len(names))
)PY";

}  // namespace

TEST_CASE("csv: figures, agreement, costs and answers are read by another reader") {
  const Folder folder;
  folder.write("check.py", check);
  folder.write("grid.json", R"({
    "seeds": 2, "n": 0.4,
    "grids": [
      {"e": [0.8, 0.9], "N": 500, "tau_max": 40, "profiles_every": 10, "fields_at": 20,
       "observables": ["temperature", "laguerre", "distribution", "correlations", "structure",
                       "clusters", "fields"]},
      {"e": 0.85, "N": 300, "tau_max": 10, "effects": [{}, {"shuffle": {"every": 1}}]}
    ]
  })");
  REQUIRE(campaign(folder, {"plan", "grid.json"}).exit_code == 0);
  REQUIRE(campaign(folder, {"run"}).exit_code == 0);
  campaign(folder, {"figures", "--out", "figures"});
  campaign(folder, {"cost", "--out", "cost"});
  REQUIRE(shell(folder, R"("$campaign" query --format csv "SELECT * FROM jobs" > jobs.csv)")
              .exit_code == 0);
  folder.write("odd.sql", R"(SELECT char(10, 34, 44) AS "a,""b", '' AS empty, NULL AS absent,
                             0.1 AS real)");
  REQUIRE(
      shell(folder, R"sh("$campaign" query --format csv "$(cat odd.sql)" > odd.csv)sh").exit_code ==
      0);
  const Outcome read =
      shell(folder, "python3 check.py 'figures/*.csv' 'cost/*.csv' jobs.csv odd.csv");
  CHECK(read.err == "");
  CHECK(read.exit_code == 0);
  // Figures 1, 3 to 6 and 8 to 14 at least, agreement.csv, cost.csv and two answers.
  CHECK(std::stoi(read.out) >= 16);
}
