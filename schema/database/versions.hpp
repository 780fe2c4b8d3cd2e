// SPDX-License-Identifier: GPL-3.0-or-later

// Whether a file is a store of ours and of which version (sql/scripts.hpp), and how it is brought
// forward.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>
#include <functional>
#include <span>
#include <string_view>

#include "schema/sql/scripts.hpp"

namespace haff::schema {

// "Haff" in ASCII: marks the file as a store (`file campaign.db` shows it).
inline constexpr int application_id = 0x48616666;

int version_of(SQLite::Database& sqlite);

// No table, no version, no mark: a file that SQLite has yet to write to.
bool is_empty(SQLite::Database& sqlite);

// Throws NameError if the file is another program's.
void must_be_store(SQLite::Database& sqlite, const std::filesystem::path& name);

// Throws StoreError if the store has seen more scripts than there are.
void must_not_be_newer(int version, std::size_t known, const std::filesystem::path& name);

// Throws Damage unless all that the first `version` scripts make is in the store, to the letter. A
// view in place of a table could keep a command busy for ever, a trigger or an index would act
// whenever the program writes. Tables and views that a user has added are left alone: the program
// never names them.
void must_have_our_schema(SQLite::Database& sqlite, int version, const std::filesystem::path& name);

// Run those scripts that bring the store from its version to the last, then `afterwards`, all in
// one transaction. Throws StoreError if it has seen more than there are.
void migrate(SQLite::Database& sqlite, const std::filesystem::path& name,
             std::span<const std::string_view> scripts,
             const std::function<void()>& afterwards = {});

}  // namespace haff::schema
