// SPDX-License-Identifier: GPL-3.0-or-later

// The rollback journal. A transaction that was cut off leaves it beside a file without a log, and
// SQLite puts its pages back when the file is next opened, without asking whether they are of this
// file.
#pragma once

#include <filesystem>

namespace haff::schema {

// Throws StoreError if the journal beside the file is known to be that of another file: a backup,
// for instance, was put in the place of the one whose `plan` was killed. Nothing is changed.
//
// Each transaction without a log adds 1 to the counter in the file's header, and the journal holds
// the page of that header as it was: the counter of the file is that of the journal, or the next. A
// copy of an earlier day has a smaller counter, and a backup by this program has one drawn at
// random. A header that was being written when power was lost is not judged.
void must_be_journal_of(const std::filesystem::path& file, const std::filesystem::path& name);

// Gives a file that no connection has open a counter drawn at random.
void draw_counter(const std::filesystem::path& file);

}  // namespace haff::schema
