// SPDX-License-Identifier: GPL-3.0-or-later

// What a job has in the store, part by part, and where a part is not as it was written.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace haff::schema {

// What a job has in the store, by the table that holds it. Each has a digest (017-digests.sql).
// A new part comes last: a store of an older version has digests of those before it.
enum class Part {
  jobs,
  samples,
  profiles,
  fields,
  results,
  invariants,
  checkpoints,
  loans,
  snapshots
};
inline constexpr std::size_t part_count = 9;
const char* name(Part part);  // of the table

// What the digests say of a job.
struct DigestsOfJob {
  std::vector<Part> wrong = {};    // these rows are not as they were written
  std::vector<Part> without = {};  // these have none: a program of an older version wrote them
};

// Where the rows of two stores differ.
struct Difference {
  Part part = Part::samples;
  std::string row;          // "tau = 3", "name = S, tau = 10, x = 0.5"; of a job's only row: empty
  std::string column = {};  // empty where one of the two lacks the row
  std::string here, there;  // both values, with all digits
  // Whether only the last digits of a logarithm or a transform differ, as between two libraries.
  bool is_in_last_digits = false;
};

}  // namespace haff::schema
