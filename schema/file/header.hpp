// SPDX-License-Identifier: GPL-3.0-or-later

// What the first bytes of a store's file say, and how long it is: asked of the file itself, past
// SQLite's pages and locks (sqlite.org/fileformat.html, "The Database Header").
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <optional>

namespace haff::schema {

struct Header {
  // Not if another program wrote the file over; nor if power was lost while it was being copied
  // from the log, which has the whole of it.
  bool is_of_database = true;
  bool expects_log = false;  // it is to be read together with the log beside it
  std::int64_t bytes = 0;    // of the file
};

// Nothing if the file cannot be read just now. It is read through SQLite's own descriptor: to close
// another one would drop the locks that this process holds on the file.
std::optional<Header> header_of(SQLite::Database& sqlite);

}  // namespace haff::schema
