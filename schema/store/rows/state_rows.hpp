// SPDX-License-Identifier: GPL-3.0-or-later

// States as rows: cut into BLOBs that SQLite takes. Private to schema/.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstddef>
#include <cstdint>
#include <span>

#include "schema/rows/measured.hpp"

namespace haff::schema {

class Database;

// `insert` has places for the position and the bytes of a chunk from `first` on.
void insert_chunks(SQLite::Statement& insert, int first, std::span<const std::byte> state);

// Replaces the state of the job. `sum` is the checksum of its bytes.
void put_state(Database& database, std::int64_t job_id, const Checkpoint& checkpoint,
               std::uint64_t sum);

}  // namespace haff::schema
