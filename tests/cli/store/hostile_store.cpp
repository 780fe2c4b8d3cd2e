// SPDX-License-Identifier: GPL-3.0-or-later

// A store made elsewhere: its text does not reach a shell, a script, a page or a terminal as a
// command.
#include <SQLiteCpp/SQLiteCpp.h>
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "cli/program.hpp"

using namespace haff::tests;

namespace {

// Ends a string of gnuplot, a tag and an attribute, and clears a terminal. SQLite refuses it in a
// column that is JSON or has a fixed set of words, unless checks are switched off.
const std::string attack =
    "x'\nEND\nsystem(\"touch\tpwned\")\n`touch pwned`\n!touch pwned\n#\"$(touch pwned)"
    "</title><script>alert(1)</script>\" onload='x'\x1b[2J\x1b]0;owned\a\u009b2J";

struct Column {
  std::string table, name;
};

std::vector<Column> text_columns(const Folder& folder) {
  const SQLite::Database store(folder.store().string(), SQLite::OPEN_READONLY);
  SQLite::Statement rows(store,
                         "SELECT m.name, c.name FROM sqlite_schema AS m, pragma_table_info(m.name) "
                         "AS c WHERE m.type = 'table' AND c.type = 'TEXT'");
  std::vector<Column> columns;
  while (rows.executeStep())
    columns.push_back({rows.getColumn(0).getString(), rows.getColumn(1).getString()});
  return columns;
}

// Puts the attack into one row of the column. False if the column cannot take it (such as a key).
bool poison(const Folder& folder, const Column& column) {
  SQLite::Database store(folder.store().string(), SQLite::OPEN_READWRITE, 10'000);
  store.exec("PRAGMA ignore_check_constraints = ON");
  try {
    SQLite::Statement change(store, "UPDATE " + column.table + " SET " + column.name +
                                        " = ? WHERE rowid = (SELECT max(rowid) FROM " +
                                        column.table + ")");
    change.bind(1, attack);
    return change.exec() > 0;
  } catch (const SQLite::Exception&) {  // tables without rowid
    SQLite::Statement change(store,
                             "UPDATE OR IGNORE " + column.table + " SET " + column.name + " = ?");
    change.bind(1, attack);
    return change.exec() > 0;
  }
}

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

bool is_clean(const std::string& text) {
  return text.find_first_of("\x1b\a") == std::string::npos &&
         text.find("\u009b") == std::string::npos;
}

}  // namespace

TEST_CASE("hostile store: text in any column, through any command") {
  const Folder made;
  made.write("grid.json", R"({"e": 0.8, "n": 0.4, "N": 500, "seeds": 5, "tau_max": 20,
    "profiles_every": 10, "fields_at": 20, "target": {"a2": {"se": 0.5, "tau": [5, 15]}},
    "observables": ["temperature", "laguerre", "correlations", "distribution", "fields"]})");
  Outcome planned = campaign(made, {"plan", "grid.json"});
  CAPTURE(planned.err);
  REQUIRE(planned.exit_code == 0);
  REQUIRE(campaign(made, {"run"}).exit_code == 0);
  const auto columns = text_columns(made);
  REQUIRE(columns.size() > 20);
  std::size_t poisoned = 0;
  for (const Column& column : columns) {
    CAPTURE(column.table);
    CAPTURE(column.name);
    const Folder folder;
    std::filesystem::copy_file(made.store(), folder.store());
    if (!poison(folder, column)) continue;
    ++poisoned;
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"figures", "--only", "1,8"},
          {"cost"},
          {"plot", "--list"},
          {"plot", "a2", "--theory"},
          {"plot", "temperature", "--by", "seed", "--out", "plot.svg"},
          {"status"},
          {"report"},
          {"verify"},
          {"query", "SELECT * FROM " + column.table},
          {"export", "2"}}) {
      CAPTURE(words.front());
      const Outcome outcome = campaign(folder, words);
      CHECK(outcome.exit_code < 128);  // not ended by a signal
      CHECK(is_clean(outcome.out));
      CHECK(is_clean(outcome.err));
    }
    CHECK_FALSE(std::filesystem::exists(folder / "pwned"));
    CHECK_FALSE(std::filesystem::exists(folder / "figures" / "pwned"));
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / "")) {
      if (entry.path().extension() != ".svg" && entry.path().extension() != ".html") continue;
      const std::string text = text_of(entry.path());
      // The page of `report` has scripts of its own.
      CHECK(text.find(entry.path().filename() == "report.html" ? "<script>alert" : "<script") ==
            std::string::npos);
      CHECK(text.find(" onload='") == std::string::npos);
    }
  }
  CHECK(poisoned > 15);
}
