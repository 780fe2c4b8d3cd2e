// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/commands/results/query.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "campaign/base/output/output.hpp"
#include "campaign/base/process/exit_code.hpp"
#include "campaign/base/text/csv.hpp"
#include "campaign/base/text/printable.hpp"
#include "campaign/base/text/text_table.hpp"
#include "schema/store/store.hpp"

namespace haff::campaign {
namespace {

using schema::Blob;
using schema::Null;
using schema::Row;

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

// Hexadecimal; a table shows the first bytes only.
std::string blob_text(const Blob& blob, std::size_t most) {
  std::string text;
  for (std::size_t k = 0; k < std::min(most, blob.size()); ++k)
    text += fmt::format("{:02x}", static_cast<unsigned>(blob[k]));
  if (blob.size() > most) text += fmt::format("... ({} bytes)", blob.size());
  return text;
}

std::string all_digits(double value) {
  // JSON has no infinity; 1e999 is read as one everywhere. SQLite has no NaN.
  if (std::isinf(value)) return value < 0 ? "-1e999" : "1e999";
  std::string text = fmt::format("{:.17g}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string json_quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

bool is_number(const schema::Value& value) {
  return std::holds_alternative<std::int64_t>(value) || std::holds_alternative<double>(value);
}

void print_rows_as_csv(schema::Query& rows) {
  const auto print = [](const auto& cells, const auto& text) {
    std::vector<std::string> fields;
    fields.reserve(cells.size());
    for (const auto& cell : cells) fields.push_back(text(cell));
    print_data(csv_line(fields));
  };
  print(rows.columns(), [](const std::string& column) { return csv_field(column); });
  while (const auto row = rows.next()) print(*row, csv_text);
}

void print_rows_as_json(schema::Query& rows) {
  print_data("[");
  bool first = true;
  while (const auto row = rows.next()) {
    std::string object = first ? "\n  {" : ",\n  {";
    first = false;
    for (std::size_t c = 0; c < row->size(); ++c)
      object += fmt::format("{}{}: {}", c > 0 ? ", " : "", json_quoted(rows.columns()[c]),
                            json_text((*row)[c]));
    print_data(object + '}');
  }
  print_data(first ? "]\n" : "\n]\n");
}

void print_rows_as_table(schema::Query& rows) {
  std::vector<Row> all;
  while (auto row = rows.next()) all.push_back(std::move(*row));
  std::vector<TextTable::Column> columns;
  for (std::size_t c = 0; c < rows.columns().size(); ++c) {
    bool numbers = !all.empty();
    for (const Row& row : all) numbers &= is_number(row[c]) || std::holds_alternative<Null>(row[c]);
    columns.push_back({rows.columns()[c], numbers ? Align::right : Align::left});
  }
  TextTable table(columns);
  for (const Row& row : all) {
    std::vector<std::string> cells;
    for (const schema::Value& value : row) cells.push_back(table_text(value));
    table.add(std::move(cells));
  }
  print_lines(table.text());
}

// ---- rows that are not as they were written ---------------------------------------------------

struct Averaged {
  const char* view;
  schema::Part part;
};

constexpr std::array averaged{Averaged{"mean_series", schema::Part::samples},
                              Averaged{"mean_temperatures", schema::Part::samples},
                              Averaged{"mean_profiles", schema::Part::profiles},
                              Averaged{"mean_tau_c", schema::Part::results}};

constexpr std::array shown{schema::Part::samples, schema::Part::profiles, schema::Part::fields,
                           schema::Part::snapshots, schema::Part::results};

// A statement names what it reads, as there are no views in a store but the program's own. What is
// named elsewhere in it, in a text or a comment, is checked for nothing.
bool names(const std::string& sql, std::string_view name) {
  const auto is_same = [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) ==
           std::tolower(static_cast<unsigned char>(b));
  };
  return std::search(sql.begin(), sql.end(), name.begin(), name.end(), is_same) != sql.end();
}

// An average over a wrong row would not show it, and is refused. Rows themselves are shown, with a
// warning, since users must be able to look at what is wrong.
void look_at_digests(const schema::Reader& store, const std::string& sql) {
  for (const Averaged& each : averaged)
    if (names(sql, each.view)) store.must_match_digests({each.part});
  try {
    for (const schema::Part part : shown)
      if (names(sql, schema::name(part))) store.must_match_digests({part});
  } catch (const schema::DamagedFile&) {
    throw;
  } catch (const schema::Damage& damage) {
    complain("Warning: {}\n", printable(damage.what()));
  }
}

}  // namespace

std::string csv_text(const schema::Value& value) {
  return std::visit(Overloaded{[](Null) { return std::string(); },
                               [](std::int64_t number) { return std::to_string(number); },
                               [](double number) { return all_digits(number); },
                               [](const std::string& text) { return csv_field(text); },
                               [](const Blob& blob) { return blob_text(blob, blob.size()); }},
                    value);
}

std::string json_text(const schema::Value& value) {
  return std::visit(
      Overloaded{[](Null) { return std::string("null"); },
                 [](std::int64_t number) { return std::to_string(number); },
                 [](double number) { return all_digits(number); },
                 [](const std::string& text) { return json_quoted(text); },
                 [](const Blob& blob) { return '"' + blob_text(blob, blob.size()) + '"'; }},
      value);
}

std::string table_text(const schema::Value& value) {
  constexpr std::size_t shown_bytes = 16;
  return std::visit(Overloaded{[](Null) { return std::string("NULL"); },
                               [](std::int64_t number) { return std::to_string(number); },
                               [](double number) { return fmt::format("{:.8g}", number); },
                               [](const std::string& text) { return printable(text); },
                               [](const Blob& blob) { return blob_text(blob, shown_bytes); }},
                    value);
}

int query(const std::filesystem::path& path, const std::string& sql, RowFormat format) {
  const schema::Reader store(path);
  schema::Query rows = store.query(sql);
  look_at_digests(store, sql);
  switch (format) {
    case RowFormat::table:
      print_rows_as_table(rows);
      break;
    case RowFormat::csv:
      print_rows_as_csv(rows);
      break;
    case RowFormat::json:
      print_rows_as_json(rows);
      break;
  }
  return exit_complete;
}

}  // namespace haff::campaign
