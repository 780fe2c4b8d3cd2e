// SPDX-License-Identifier: GPL-3.0-or-later

// A flipped bit in a row of the table jobs is turned back. Rows of results can be computed again,
// but a job's tau_max stands nowhere else. The digest tells when the row is right, and single bits
// are few: 64 for each of some forty numbers, 8 for each character. Once in 10^15 times a row other
// than the one that was written would have the same digest.
#include <algorithm>
#include <bit>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "schema/database/database.hpp"
#include "schema/digests/checksum.hpp"
#include "schema/store/rows/job_rows.hpp"
#include "schema/store/store.hpp"

namespace haff::schema {

namespace {

using Word = DigestedTable::Word;
using Stored = std::variant<std::int64_t, double, std::string>;

// A value of the row, and the value that it was.
struct Turned {
  std::size_t column = 0;
  Stored value;
};

Word word_of(const std::string& text) {
  return {3, checksum(std::as_bytes(std::span(text)))};
}

std::size_t place_of(const DigestedTable& table, std::string_view column) {
  return static_cast<std::size_t>(std::ranges::find(table.names(), column) - table.names().begin());
}

// Each value with one bit turned, until `is_right` says yes.
template <class IsRight>
std::optional<Stored> turned(const SQLite::Column& value, IsRight&& is_right) {
  if (value.isText()) {
    std::string text = value.getString();
    for (char& character : text)
      for (unsigned bit = 0; bit < 8; ++bit) {
        const char before = character;
        character = static_cast<char>(static_cast<unsigned char>(before) ^ (1U << bit));
        if (is_right(word_of(text))) return text;
        character = before;
      }
    return std::nullopt;
  }
  if (!value.isInteger() && !value.isFloat()) return std::nullopt;
  const Word now = DigestedTable::word(value);
  for (unsigned bit = 0; bit < 64; ++bit) {
    const Word candidate{now.type, now.value ^ (std::uint64_t{1} << bit)};
    if (!is_right(candidate)) continue;
    if (value.isInteger()) return static_cast<std::int64_t>(candidate.value);
    return std::bit_cast<double>(candidate.value);
  }
  return std::nullopt;
}

std::optional<Turned> bit_turned_back(SQLite::Statement& row, const DigestedTable& table,
                                      std::vector<Word> words, std::uint64_t written) {
  for (std::size_t k = 0; k < words.size(); ++k) {
    const Word now = words[k];
    const auto value = turned(row.getColumn(static_cast<int>(k)), [&](const Word& candidate) {
      words[k] = candidate;
      return table.digest(words) == written;
    });
    if (value) return Turned{k, *value};
    words[k] = now;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Difference> Store::turn_bit_back(std::int64_t job_id) {
  return database().transaction([&]() -> std::optional<Difference> {
    Digests& digests = database().digests();
    const auto written = digests.stored(job_id, Part::jobs);
    if (!written) return std::nullopt;
    const DigestedTable& table = digests.table(Part::jobs);
    SQLite::Statement row(database().sqlite(),
                          "SELECT " + table.columns() + " FROM jobs WHERE job_id = ?");
    row.bind(1, job_id);
    if (!row.executeStep()) return std::nullopt;
    // A claim may have found the row wrong before, and noted that in it.
    std::vector<Word> words;
    words.reserve(static_cast<std::size_t>(row.getColumnCount()));
    for (int k = 0; k < row.getColumnCount(); ++k)
      words.push_back(DigestedTable::word(row.getColumn(k)));
    const std::uint64_t wanted = *written ^ table.digest_of_none();
    auto found = bit_turned_back(row, table, words, wanted);
    const bool was_condemned =
        !found && row.getColumn("status").getString() == name(Status::failed);
    if (was_condemned) {
      words[place_of(table, "status")] = word_of(std::string(name(Status::pending)));
      words[place_of(table, "error")] = {};
      found = bit_turned_back(row, table, words, wanted);
    }
    if (!found) return std::nullopt;

    const std::string& column = table.names()[found->column];
    Difference difference{.part = Part::jobs,
                          .row = {},
                          .column = column,
                          .here = described(row.getColumn(static_cast<int>(found->column))),
                          .there = {}};
    SQLite::Statement update(database().sqlite(), "UPDATE jobs SET " + column +
                                                      " = ? WHERE job_id = ? RETURNING " + column);
    std::visit([&](const auto& value) { update.bind(1, value); }, found->value);
    update.bind(2, job_id);
    update.executeStep();
    difference.there = described(update.getColumn(0));
    update.reset();
    if (was_condemned) {
      SQLite::Statement reopen(database().sqlite(),
                               "UPDATE jobs SET status = 'pending', error = NULL WHERE job_id = ?");
      reopen.bind(1, job_id);
      reopen.exec();
    }
    digests.must_match(job_id, Part::jobs);
    return difference;
  });
}

}  // namespace haff::schema
