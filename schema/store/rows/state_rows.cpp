// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/store/rows/state_rows.hpp"

#include <algorithm>

#include "schema/database/database.hpp"
#include "schema/database/prepared.hpp"
#include "schema/store/rows/bind.hpp"

namespace haff::schema {

void insert_chunks(SQLite::Statement& insert, int first, std::span<const std::byte> state) {
  for (std::size_t begin = 0; begin < state.size(); begin += chunk_bytes) {
    const auto chunk = state.subspan(begin, std::min(chunk_bytes, state.size() - begin));
    insert.reset();
    insert.bind(first, static_cast<std::int64_t>(begin / chunk_bytes));
    insert.bindNoCopy(first + 1, chunk.data(), static_cast<int>(chunk.size()));
    insert.exec();
  }
}

void put_state(Database& database, std::int64_t job_id, const Checkpoint& checkpoint,
               std::uint64_t sum) {
  Prepared drop(database, "DELETE FROM checkpoint_chunks WHERE job_id = ?");
  drop.bind(1, job_id);
  drop.exec();

  Prepared header(
      database,
      "INSERT OR REPLACE INTO checkpoints (job_id, tau, collisions, bytes, checksum, created) "
      "VALUES (?, ?, ?, ?, ?, " +
          now + ")");
  header.bind(1, job_id);
  header.bind(2, checkpoint.tau);
  header.bind(3, checkpoint.collisions);
  header.bind(4, static_cast<std::int64_t>(checkpoint.state.size()));
  header.bind(5, static_cast<std::int64_t>(sum));
  header.exec();

  Prepared insert(database,
                  "INSERT INTO checkpoint_chunks (job_id, position, bytes) VALUES (?, ?, ?)");
  insert.bind(1, job_id);
  insert_chunks(insert, 2, checkpoint.state);
}

}  // namespace haff::schema
