// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/file/journal.hpp"

#include <array>
#include <cstdint>
#include <fstream>
#include <optional>
#include <random>
#include <string>
#include <string_view>

#include "schema/error.hpp"
#include "schema/file/name.hpp"

namespace haff::schema {

namespace {

// The header of a database, and that of a journal (SQLite, "Database File Format", sections 1.3
// and 3). Numbers are written with their first byte first.
constexpr std::string_view magic_of_file{"SQLite format 3\0", 16};
constexpr std::string_view magic_of_journal{"\xd9\xd5\x05\xf9\x20\xa1\x63\xd7", 8};
constexpr std::size_t counter_at = 24, counter_of_size_at = 92, header_bytes = 100;
constexpr std::size_t records_at = 8, sector_size_at = 20, page_size_at = 24;
constexpr std::size_t journal_header_bytes = 28;

std::uint32_t number_at(std::string_view bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t k = at; k < at + 4; ++k)
    number = number << 8U | static_cast<unsigned char>(bytes[k]);
  return number;
}

std::optional<std::string> bytes_of(std::ifstream& file, std::uint64_t at, std::size_t count) {
  std::string bytes(count, '\0');
  file.clear();
  file.seekg(static_cast<std::streamoff>(at));
  if (!file.read(bytes.data(), static_cast<std::streamsize>(count))) return std::nullopt;
  return bytes;
}

// The counter in the header of a database, or nothing if it is none.
std::optional<std::uint32_t> counter_in(const std::optional<std::string>& header) {
  if (!header || !header->starts_with(magic_of_file)) return std::nullopt;
  return number_at(*header, counter_at);
}

std::optional<std::uint32_t> counter_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return counter_in(bytes_of(stream, 0, header_bytes));
}

// The counter before the transaction; nothing if the journal is not one to be put back, or does not
// hold the page of the header. A journal is a header that fills a sector, then records (the number
// of a page, the page, a sum), then at the next sector perhaps a further header.
std::optional<std::uint32_t> counter_before(const std::filesystem::path& journal) {
  std::ifstream stream(journal, std::ios::binary);
  for (std::uint64_t at = 0;;) {
    const auto header = bytes_of(stream, at, journal_header_bytes);
    if (!header || !header->starts_with(magic_of_journal)) return std::nullopt;
    const std::uint64_t sector = number_at(*header, sector_size_at);
    const std::uint64_t record = 4 + std::uint64_t{number_at(*header, page_size_at)} + 4;
    const std::uint32_t records = number_at(*header, records_at);
    if (sector < journal_header_bytes) return std::nullopt;
    at += sector;
    for (std::uint32_t k = 0; k < records; ++k, at += record) {
      const auto page = bytes_of(stream, at, 4);
      if (!page) return std::nullopt;
      if (number_at(*page, 0) == 1) return counter_in(bytes_of(stream, at + 4, header_bytes));
    }
    at = (at + sector - 1) / sector * sector;
  }
}

}  // namespace

void must_be_journal_of(const std::filesystem::path& file, const std::filesystem::path& name) {
  const std::filesystem::path journal = beside(file, "-journal");
  const auto before = counter_before(journal);
  const auto counter = counter_of(file);
  if (!counter || !before || *counter == *before || *counter == *before + 1) return;
  // A transaction that goes on in another process, and began after our first look.
  if (counter_before(journal) != before || counter_of(file) != counter) return;
  throw StoreError(name.string() + ": the rollback journal beside it, " + journal.string() +
                   ", is that of another file, in whose place this one was put; SQLite would mix "
                   "the two. Move the journal away, to where that file is if you still have it, "
                   "then give the same command again");
}

void draw_counter(const std::filesystem::path& file) {
  const std::uint32_t drawn = std::random_device{}();
  std::array<char, 4> bytes{};
  for (std::size_t k = 0; k < bytes.size(); ++k)
    bytes[k] = static_cast<char>(drawn >> (24 - 8 * k) & 0xffU);
  std::fstream stream(file, std::ios::binary | std::ios::in | std::ios::out);
  // The second says of which counter the size in the header is.
  for (const std::size_t at : {counter_at, counter_of_size_at})
    stream.seekp(static_cast<std::streamoff>(at)).write(bytes.data(), bytes.size());
  if (!stream.flush()) throw DiskError(file.string() + ": cannot be written");
}

}  // namespace haff::schema
