// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/base/output/output_files.hpp"

#include <doctest/doctest.h>

#include <sstream>

#include "campaign/base/output/write_file.hpp"
#include "support/temporary_folder.hpp"

using namespace haff::campaign;

TEST_CASE(
    "output files: one that cannot be written is named with the reason, and the others exist") {
  const haff::TemporaryFolder folder;
  const auto write = [](const std::filesystem::path& file) { write_file(file, "text"); };
  OutputFiles files;
  CHECK(files.attempt(folder / "a.csv", write));
  CHECK_FALSE(files.attempt("/nowhere/b.csv", write));
  CHECK_FALSE(files.attempt("/nowhere/c.csv", write));
  CHECK(files.attempt(folder / "d.csv", write));
  CHECK(files.written().size() == 2);
  CHECK_FALSE(files.is_complete());
  std::ostringstream report;
  files.print_missing(report);
  CHECK(report.str() ==
        "Missing: /nowhere/b.csv, /nowhere/c.csv: cannot be written: No such file or directory\n");
}
