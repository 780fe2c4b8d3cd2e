// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/file/header.hpp"

#include <sqlite3.h>

#include <array>
#include <string_view>

namespace haff::schema {

std::optional<Header> header_of(SQLite::Database& sqlite) {
  constexpr std::string_view magic{"SQLite format 3\0", 16};
  constexpr int place = 19;  // of the version that a reader must know: 1 without a log, 2 with one
  constexpr char with_log = 2;
  sqlite3_file* file = nullptr;
  if (sqlite3_file_control(sqlite.getHandle(), "main", SQLITE_FCNTL_FILE_POINTER, &file) !=
          SQLITE_OK ||
      file == nullptr || file->pMethods == nullptr)
    return std::nullopt;
  sqlite3_int64 bytes = 0;
  std::array<char, place + 1> first{};
  if (file->pMethods->xFileSize(file, &bytes) != SQLITE_OK) return std::nullopt;
  const int result = file->pMethods->xRead(file, first.data(), static_cast<int>(first.size()), 0);
  if (result != SQLITE_OK && result != SQLITE_IOERR_SHORT_READ) return std::nullopt;
  return Header{.is_of_database = std::string_view(first.data(), magic.size()) == magic,
                .expects_log = first[place] == with_log,
                .bytes = bytes};
}

}  // namespace haff::schema
