// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/digests/digests.hpp"

#include <sqlite3.h>

#include <algorithm>
#include <bit>
#include <span>
#include <stdexcept>
#include <utility>

#include "schema/digests/checksum.hpp"
#include "schema/rows/column.hpp"

namespace haff::schema {

namespace {

constexpr std::array part_names{"jobs",       "samples",     "profiles", "fields",   "results",
                                "invariants", "checkpoints", "loans",    "snapshots"};
static_assert(part_names.size() == part_count);

// Tables with one row a job, whose rowid is the job's number: SQLite says which row has changed.
constexpr std::array by_rowid{Part::jobs, Part::results, Part::invariants, Part::checkpoints};

// Tables that are digested as a whole. They are small, and change seldom.
constexpr std::array whole_tables{"campaign", "shards", "targets", "target_predictions"};

std::size_t place(Part part) {
  return static_cast<std::size_t>(part);
}

std::uint64_t mix(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}

std::uint64_t fnv(const void* bytes, int size) {
  return checksum({static_cast<const std::byte*>(bytes), static_cast<std::size_t>(size)});
}

std::uint64_t fnv(std::string_view text) {
  return fnv(text.data(), static_cast<int>(text.size()));
}

std::int64_t stored_form(std::uint64_t digest) {
  return static_cast<std::int64_t>(digest);
}

// "jobs, samples, ..."
template <class Word>
std::string list(const std::vector<Part>& parts, Word&& word) {
  std::string text;
  for (const Part part : parts) text += (text.empty() ? "" : ", ") + std::string(word(part));
  return text;
}

// A column that was renamed is digested under its old name, so that its digests stay as they are.
std::string name_in_digests(const std::string& column) {
  return column == "tau_reached" ? "tau" : column;
}

// A statement that is used again and again lets go of the store in between.
class InUse {
 public:
  explicit InUse(SQLite::Statement& statement) : statement_(statement) {}
  ~InUse() { statement_.tryReset(); }
  InUse(const InUse&) = delete;
  InUse& operator=(const InUse&) = delete;

 private:
  SQLite::Statement& statement_;
};

}  // namespace

const char* name(Part part) {
  return part_names.at(place(part));
}

// ---- rows -------------------------------------------------------------------------------------

DigestedTable::DigestedTable(SQLite::Database& sqlite, const char* name) : name_(mix(fnv(name))) {
  SQLite::Statement info(sqlite, "SELECT name, dflt_value, type FROM pragma_table_info(?)");
  info.bind(1, name);
  while (info.executeStep()) {
    const std::string column = info.getColumn(0).getString();
    if (column == "job_id" && std::string_view(name) != "jobs") continue;
    names_.push_back(column);
    list_ += (list_.empty() ? "" : ", ") + column;
    const std::string otherwise =
        info.getColumn(1).isNull() ? "NULL" : info.getColumn(1).getString();
    SQLite::Statement value(sqlite, "SELECT " + otherwise);
    value.executeStep();
    const bool is_real = info.getColumn(2).getString() == "REAL";
    columns_.push_back({fnv(name_in_digests(column)), is_real, word(value.getColumn(0), is_real)});
  }
}

DigestedTable::Word DigestedTable::word(const SQLite::Column& value) {
  if (value.isNull()) return {0, 0};
  if (value.isInteger()) return {1, static_cast<std::uint64_t>(value.getInt64())};
  if (value.isFloat()) return {2, std::bit_cast<std::uint64_t>(value.getDouble() + 0.0)};
  return {value.isText() ? 3U : 4U, fnv(value.getBlob(), value.getBytes())};
}

DigestedTable::Word DigestedTable::word(const SQLite::Column& value, bool is_real) {
  if (!is_real || !value.isInteger()) return word(value);
  return {2, std::bit_cast<std::uint64_t>(static_cast<double>(value.getInt64()))};
}

std::uint64_t DigestedTable::digest(SQLite::Statement& row) const {
  static thread_local std::vector<Word> words;
  words.clear();
  for (int k = 0; k < static_cast<int>(columns_.size()); ++k)
    words.push_back(word(row.getColumn(k), columns_[static_cast<std::size_t>(k)].is_real));
  return digest(words);
}

std::uint64_t DigestedTable::digest(const std::vector<Word>& row) const {
  std::uint64_t h = name_;
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    if (row[k] == columns_[k].by_default) continue;
    h = mix(h ^ columns_[k].name);
    h = mix(h + row[k].type);
    h = mix(h ^ row[k].value);
  }
  return h;
}

// ---- reading ----------------------------------------------------------------------------------

const DigestedTable& Digests::table(Part part) {
  auto& table = tables_.at(place(part));
  if (!table) table = std::make_unique<DigestedTable>(sqlite_, name(part));
  return *table;
}

// Those that the table has digests of: a copy of a store of an older version is not brought
// forward.
const std::vector<Part>& Digests::parts() {
  if (!parts_.empty()) return parts_;
  SQLite::Statement columns(sqlite_, "SELECT name FROM pragma_table_info('digests')");
  std::set<std::string> names;
  while (columns.executeStep()) names.insert(columns.getColumn(0).getString());
  for (std::size_t k = 0; k < part_count; ++k)
    if (names.contains(part_names.at(k))) parts_.push_back(static_cast<Part>(k));
  return parts_;
}

SQLite::Statement& Digests::rows_of(Part part) {
  auto& rows = rows_.at(place(part));
  if (!rows)
    rows = std::make_unique<SQLite::Statement>(
        sqlite_, "SELECT " + table(part).columns() + " FROM " + name(part) + " WHERE job_id = ?");
  return *rows;
}

std::uint64_t Digests::present(std::int64_t job_id, Part part) {
  SQLite::Statement& rows = rows_of(part);
  const InUse in_use(rows);
  rows.bind(1, job_id);
  std::uint64_t all = table(part).digest_of_none();
  while (rows.executeStep()) all ^= table(part).digest(rows);
  return all;
}

bool Digests::has(std::int64_t job_id) {
  SQLite::Statement row(sqlite_, "SELECT 1 FROM digests WHERE job_id = ?");
  row.bind(1, job_id);
  return row.executeStep();
}

std::optional<std::uint64_t> Digests::stored(std::int64_t job_id, Part part) {
  return row(job_id).at(place(part));
}

void Digests::must_match(std::int64_t job_id, Part part) {
  const auto written = stored(job_id, part);
  if (written && *written != present(job_id, part))
    throw Altered("job " + std::to_string(job_id) + ": " +
                  (part == Part::jobs
                       ? "its row of the table jobs is not as it was"
                       : std::string("its ") + name(part) + " are not as they were") +
                  " written, as the digest shows: a bit has flipped, or another program has "
                  "changed something");
  if (part == Part::jobs) checked_.insert(job_id);
}

std::uint64_t Digests::of_table(const std::string& name) {
  const DigestedTable table(sqlite_, name.c_str());
  SQLite::Statement rows(sqlite_, "SELECT " + table.columns() + " FROM " + name);
  std::uint64_t all = table.digest_of_none();
  while (rows.executeStep()) all ^= table.digest(rows);
  return all;
}

std::optional<bool> Digests::matches(const std::string& table) {
  SQLite::Statement written(sqlite_, "SELECT digest FROM table_digests WHERE name = ?");
  written.bind(1, table);
  if (!written.executeStep()) return std::nullopt;
  return written.getColumn(0).getInt64() == stored_form(of_table(table));
}

std::vector<std::string> Digests::wrong_tables() {
  const bool is_older = sqlite_.execAndGet("SELECT count(*) FROM table_digests").getInt() == 0;
  std::vector<std::string> wrong;
  for (const char* table : whole_tables)
    if (!matches(table).value_or(is_older)) wrong.emplace_back(table);
  return wrong;
}

// The digests of a job, as they are stored or, in a transaction that writes, as they will be.
Digests::Row& Digests::row(std::int64_t job_id) {
  if (!is_writing_) known_.clear();  // others may have written since
  if (const auto known = known_.find(job_id); known != known_.end()) return known->second;
  Row row;
  if (new_.contains(job_id)) {
    for (const Part part : parts()) row.at(place(part)) = table(part).digest_of_none();
  } else {
    if (!read_)
      read_ = std::make_unique<SQLite::Statement>(
          sqlite_, "SELECT " + list(parts(), name) + " FROM digests WHERE job_id = ?");
    const InUse in_use(*read_);
    read_->bind(1, job_id);
    if (!read_->executeStep())
      throw Altered("job " + std::to_string(job_id) + ": its digests are gone");
    for (std::size_t k = 0; k < parts().size(); ++k)
      if (const auto value = read_->getColumn(static_cast<int>(k)); !value.isNull())
        row.at(place(parts()[k])) = static_cast<std::uint64_t>(value.getInt64());
  }
  return known_[job_id] = row;
}

// ---- writing ----------------------------------------------------------------------------------

void Digests::notice(void* self, int operation, const char*, const char* table, long long rowid) {
  Digests& digests = *static_cast<Digests*>(self);
  const std::string_view name(table);
  for (const Part part : by_rowid)
    if (name == schema::name(part)) {
      if (part == Part::jobs && operation == SQLITE_INSERT) digests.new_.insert(rowid);
      digests.changed_.emplace(rowid, part);
      return;
    }
  if (std::ranges::find(whole_tables, name) != whole_tables.end())
    digests.changed_tables_.emplace(name);
}

void Digests::begin() {
  drop();
  is_writing_ = true;
  sqlite3_update_hook(sqlite_.getHandle(), notice, this);
}

void Digests::drop() noexcept {
  sqlite3_update_hook(sqlite_.getHandle(), nullptr, nullptr);
  is_writing_ = false;
  known_.clear();
  checked_.clear();
  left_alone_.clear();
  new_.clear();
  touched_.clear();
  changed_.clear();
  checked_tables_.clear();
  changed_tables_.clear();
}

void Digests::must_match_table(const std::string& table) {
  if (matches(table) == false)
    throw Altered("the table " + table +
                  " is not as it was written, as its digest shows: a bit has flipped, or another "
                  "program has changed it");
  checked_tables_.insert(table);
}

void Digests::added(std::int64_t job_id, Part part, std::uint64_t digest) {
  auto& sum = row(job_id).at(place(part));
  if (sum) *sum ^= digest;
  touched_.insert(job_id);
}

void Digests::changed(std::int64_t job_id, Part part) {
  if (part == Part::jobs) checked_.insert(job_id);
  changed_.emplace(job_id, part);
}

void Digests::changed_table(const std::string& table) {
  checked_tables_.insert(table);
  changed_tables_.insert(table);
}

void Digests::forget(std::int64_t job_id, Part part) {
  row(job_id).at(place(part)).reset();
  touched_.insert(job_id);
}

void Digests::removed(std::int64_t job_id) {
  known_.erase(job_id);
  for (auto* jobs : {&checked_, &left_alone_, &new_, &touched_}) jobs->erase(job_id);
  std::erase_if(changed_, [&](const auto& change) { return change.first == job_id; });
}

void Digests::leave_alone(std::int64_t job_id) {
  left_alone_.insert(job_id);
}

void Digests::digest_tables() {
  for (const char* table : whole_tables)
    if (!matches(table)) changed_table(table);
}

void Digests::settle() {
  sqlite3_update_hook(sqlite_.getHandle(), nullptr, nullptr);
  for (const auto& [job_id, part] : changed_) {
    if (part == Part::jobs && left_alone_.contains(job_id)) continue;
    if (part == Part::jobs && !checked_.contains(job_id) && !new_.contains(job_id))
      throw std::logic_error("the row of job " + std::to_string(job_id) +
                             " was changed without a look at its digest");
    row(job_id).at(place(part)) = present(job_id, part);
    touched_.insert(job_id);
  }
  if (!write_ && !touched_.empty())
    write_ = std::make_unique<SQLite::Statement>(
        sqlite_, "INSERT OR REPLACE INTO digests (job_id, " + list(parts(), name) +
                     ") VALUES (?, " + list(parts(), [](Part) { return "?"; }) + ")");
  for (const std::int64_t job_id : touched_) {
    const InUse in_use(*write_);
    write_->clearBindings();
    write_->bind(1, job_id);
    const Row& digests = row(job_id);
    for (std::size_t k = 0; k < parts().size(); ++k)
      if (const auto& digest = digests.at(place(parts()[k])))
        write_->bind(static_cast<int>(k) + 2, stored_form(*digest));
    write_->exec();
  }
  for (const std::string& table : changed_tables_) {
    if (!checked_tables_.contains(table))
      throw std::logic_error("the table " + table + " was changed without a look at its digest");
    SQLite::Statement write(sqlite_,
                            "INSERT OR REPLACE INTO table_digests (name, digest) VALUES (?, ?)");
    write.bind(1, table);
    write.bind(2, stored_form(of_table(table)));
    write.exec();
  }
  drop();
}

}  // namespace haff::schema
