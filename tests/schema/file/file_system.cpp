// SPDX-License-Identifier: GPL-3.0-or-later

// The requests of SQLite to the disk, and the effects of the disk's answers.
#include "schema/file/file_system.hpp"

#include <doctest/doctest.h>

#include <cstring>
#include <fstream>
#include <string>

#include "schema/fixture.hpp"

using namespace haff::schema;

namespace {

std::string big_endian(std::uint32_t value) {
  std::string text;
  for (int shift = 24; shift >= 0; shift -= 8) text += static_cast<char>(value >> shift & 0xffU);
  return text;
}

// A rollback journal without a page in it, which names `victim` as the super-journal of its
// transaction (sqlite.org/fileformat.html, "The Rollback Journal"; pager.c, writeSuperJournal).
std::string crafted_journal(const std::string& victim, std::uint32_t pages) {
  constexpr std::uint32_t sector = 512, page = 4096, lock_page = 0x40000000 / page + 1;
  const std::string magic("\xd9\xd5\x05\xf9\x20\xa1\x63\xd7", 8);
  std::string header = magic + big_endian(0) + big_endian(12345) + big_endian(pages) +
                       big_endian(sector) + big_endian(page);
  header.resize(sector);
  std::uint32_t sum = 0;
  for (const char c : victim) sum += static_cast<std::uint32_t>(c);
  return header + big_endian(lock_page) + victim +
         big_endian(static_cast<std::uint32_t>(victim.size())) + big_endian(sum) + magic;
}

}  // namespace

TEST_CASE("a journal that names a user's file does not cause it to be deleted or opened") {
  const TemporaryFolder folder;
  const auto path = folder / "a.db";
  const auto victim = folder / "thesis.tex";
  Store::create(path).add(plan({cooling()}));
  const std::string text = "precious data of the user";
  std::ofstream(victim) << text;
  const auto pages = static_cast<std::uint32_t>(std::filesystem::file_size(path) / 4096);
  const std::string journal = crafted_journal(victim.string(), pages);
  const auto put = [&] { std::ofstream(path.string() + "-journal", std::ios::binary) << journal; };

  for (const auto& use : {+[](const std::filesystem::path& name) { Reader{name}; },
                          +[](const std::filesystem::path& name) { Store::open(name); },
                          +[](const std::filesystem::path& name) { Store::create(name); }}) {
    put();
    std::string said = "it was used";
    try {
      use(path);
    } catch (const StoreError& error) {
      said = error.what();
    }
    CHECK(said.find("names another file, " + victim.string()) != std::string::npos);
    std::string left;
    std::getline(std::ifstream(victim), left);
    CHECK(left == text);
  }
  std::filesystem::remove(path.string() + "-journal");
  CHECK(Reader(path).jobs().size() == 2);
}

TEST_CASE(
    "a plan cut off by power loss leaves an unfinished store, which the next plan completes") {
  const TemporaryFolder folder;
  const auto path = folder / "a.db";
  Store::create(path);
  // The first page is empty, as it was before the transaction: SQLite undoes all of it.
  const std::string magic("\xd9\xd5\x05\xf9\x20\xa1\x63\xd7", 8);
  std::string header = magic + big_endian(0) + big_endian(12345) + big_endian(0) + big_endian(512) +
                       big_endian(4096);
  header.resize(512);
  std::ofstream(path.string() + "-journal", std::ios::binary) << header;
  std::string said;
  try {
    Reader{path};
  } catch (const NameError& error) {
    said = error.what();
  }
  CHECK(said.find("is empty") != std::string::npos);
  CHECK(said.find("cut off") != std::string::npos);
  Store::create(path).add(plan({cooling()}));
  CHECK(Reader(path).jobs().size() == 2);
}
