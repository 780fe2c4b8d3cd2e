// SPDX-License-Identifier: GPL-3.0-or-later

// `campaign query`: one SQL statement that reads, its rows as a table, CSV or JSON.
#pragma once

#include <filesystem>
#include <string>

#include "schema/database/query.hpp"

namespace haff::campaign {

enum class RowFormat { table, csv, json };

// Prints the rows; returns an ExitCode. Throws schema::QueryError.
int query(const std::filesystem::path& store, const std::string& sql, RowFormat format);

// One value. Reals have all 17 digits in CSV and JSON and stay reals (1.0, not 1); NULL is empty
// in CSV and null in JSON; BLOBs are hexadecimal.
std::string csv_text(const schema::Value& value);
std::string json_text(const schema::Value& value);
std::string table_text(const schema::Value& value);

}  // namespace haff::campaign
