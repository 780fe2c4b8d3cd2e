// SPDX-License-Identifier: GPL-3.0-or-later

// Rows that are not as they were written: put right, dropped, digested again.
#include <set>

#include "schema/database/database.hpp"
#include "schema/store/rows/job_rows.hpp"
#include "schema/store/store.hpp"

namespace haff::schema {

void Store::make_derived_anew() {
  database().transaction([&] { schema::make_derived_anew(database()); });
}

std::int64_t Store::replace_rows(std::int64_t job_id, Part part, const Reader& other,
                                 std::int64_t job_there) {
  return database().transaction([&] {
    const RowsOfJob ours{database(), job_id}, theirs{other.database(), job_there};
    const auto written = database().digests().stored(job_id, part);
    const LastDigits last_digits = written && *written != database().digests().present(job_id, part)
                                       ? LastDigits::must_agree
                                       : LastDigits::may_differ;
    std::set<std::string> rows;
    for (const Difference& difference : schema::differences(ours, theirs, part))
      if (last_digits == LastDigits::must_agree || !difference.is_in_last_digits)
        rows.insert(difference.row);
    const char* chunks = chunks_of(part);
    if (chunks != nullptr) drop_rows(ours, chunks);
    drop_differing_rows(ours, theirs, part, last_digits);
    add_rows(ours, theirs, name(part));
    if (chunks != nullptr) add_rows(ours, theirs, chunks);
    database().digests().changed(job_id, part);
    return static_cast<std::int64_t>(rows.size());
  });
}

void Store::digest_again(std::int64_t job_id, Part part) {
  database().transaction([&] {
    SQLite::Statement make(database().sqlite(),
                           "INSERT OR IGNORE INTO digests (job_id) VALUES (?)");
    make.bind(1, job_id);
    make.exec();
    database().digests().changed(job_id, part);
  });
}

void Store::digest_table_again(const std::string& table) {
  database().transaction([&] { database().digests().changed_table(table); });
}

std::int64_t Store::drop_rows_after(std::int64_t job_id, double tau) {
  return database().transaction([&] {
    const auto remove = [&](const std::string& sql) {
      SQLite::Statement statement(database().sqlite(), "DELETE FROM " + sql);
      statement.bind(1, job_id);
      statement.bind(2, tau);
      return static_cast<std::int64_t>(statement.exec());
    };
    const auto drop = [&](Part part) {
      const std::int64_t dropped =
          remove(std::string(name(part)) + " WHERE job_id = ? AND tau > ?");
      database().digests().changed(job_id, part);
      return dropped;
    };
    const std::int64_t samples = drop(Part::samples);
    drop(Part::profiles);
    drop(Part::fields);
    remove(
        "snapshot_chunks WHERE job_id = ?1 AND time IN "
        "(SELECT time FROM snapshots WHERE job_id = ?1 AND tau > ?2)");
    drop(Part::snapshots);
    drop_rows({database(), job_id}, name(Part::results));
    return samples;
  });
}

}  // namespace haff::schema
