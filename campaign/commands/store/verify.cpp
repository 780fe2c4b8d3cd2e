// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/commands/store/verify.hpp"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "campaign/base/output/output.hpp"
#include "campaign/base/process/exit_code.hpp"
#include "campaign/base/text/command_text.hpp"
#include "campaign/base/text/job_text.hpp"
#include "campaign/base/text/number_text.hpp"
#include "campaign/base/text/printable.hpp"
#include "campaign/base/text/text_table.hpp"
#include "campaign/commands/json_output.hpp"
#include "campaign/commands/store/job_faults.hpp"
#include "campaign/commands/store/recompute.hpp"
#include "campaign/commands/store/repair.hpp"
#include "schema/store/store.hpp"

namespace haff::campaign {
namespace {

using nlohmann::ordered_json;

using schema::JobRow;
using schema::Reader;

// What was found, sorted by what helps against it.
struct Findings {
  std::vector<std::string> file;     // SQLite cannot read it, or finds it in disorder
  std::vector<std::string> derived;  // indexes and statistics: the tables have all of it
  std::vector<std::string> jobs;     // rows of the table jobs that this program did not write
  std::vector<std::string> states;   // damaged checkpoints
  std::vector<std::string> rows;     // results that cannot be
  std::vector<std::string> tables;   // small tables that are not as they were written
  std::vector<std::string> newer;    // of a newer program
  std::vector<std::string> unknown;  // what the system could not read

  bool lacks_log = false;            // a copy made while a run was on
  std::int64_t without_digests = 0;  // jobs: no fault, but changes of their rows go unseen

  std::size_t faults() const {
    return file.size() + derived.size() + jobs.size() + states.size() + rows.size() + tables.size();
  }
  bool empty() const { return faults() + newer.size() + unknown.size() == 0 && !lacks_log; }
};

std::map<std::int64_t, std::string> stored_identities(const Reader& store) {
  auto rows = store.query("SELECT job_id, identity FROM jobs");
  std::map<std::int64_t, std::string> identities;
  while (const auto row = rows.next())
    if (const auto* text = std::get_if<std::string>(&row->at(1)))
      identities[std::get<std::int64_t>(row->at(0))] = *text;
  return identities;
}

void look_at(const Reader& store, const JobRow& row, Findings& found) {
  const std::string job = fmt::format("job {} ({}): ", row.job_id, describe(row.job));
  const JobFaults faults = faults_of(store, row);
  if (faults.state) found.states.push_back(job + *faults.state);
  if (faults.lacks_digests) ++found.without_digests;
  if (faults.newer) found.newer.push_back(job + *faults.newer);
  for (const std::string& fault : faults.rows) found.rows.push_back(job + fault);
}

void look_at_jobs(const Reader& store, Findings& found) {
  const auto identities = stored_identities(store);
  for (const std::int64_t job_id : store.job_ids()) try {
      const JobRow row = store.job(job_id);
      const auto stored = identities.find(job_id);
      if (stored == identities.end() || stored->second != identity(row.job))
        found.jobs.push_back(fmt::format("job {} ({}): its columns do not make up its identity",
                                         job_id, describe(row.job)));
      look_at(store, row, found);
    } catch (const schema::Damage& damage) {
      found.jobs.emplace_back(damage.what());
    }
}

// The statuses are the program's own.
void look_at_statuses(const Reader& store, Findings& found) {
  auto rows = store.query("SELECT position, status, meaning FROM job_status ORDER BY position");
  std::size_t k = 0;
  bool is_ours = true;
  while (const auto row = rows.next()) {
    is_ours = is_ours && k < schema::statuses.size() &&
              row->at(0) == schema::Value(static_cast<std::int64_t>(k)) &&
              row->at(1) == schema::Value(std::string(schema::statuses[k].name)) &&
              row->at(2) == schema::Value(std::string(schema::statuses[k].meaning));
    ++k;
  }
  if (!is_ours || k != schema::statuses.size())
    found.file.emplace_back("the table job_status is not as this program writes it");
}

void look_at_tables(const Reader& store, Findings& found) {
  look_at_statuses(store, found);
  for (const std::string& table : store.wrong_tables())
    found.tables.push_back("the table " + table + " is not as it was written (its digest)");
}

std::string size_text(const Reader& store) {
  auto rows = store.query(
      "SELECT (SELECT count(*) FROM jobs), (SELECT count(*) FROM samples), "
      "(SELECT count(*) FROM checkpoints)");
  const auto counts = rows.next().value();
  const auto count = [&](std::size_t k) { return count_text(std::get<std::int64_t>(counts[k])); };
  return fmt::format("{} jobs, {} samples, {} checkpoints", count(0), count(1), count(2));
}

void print(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) say("{}\n", printable(line));
}

void print(const Findings& found, const std::filesystem::path& path) {
  for (const auto* lines : {&found.file, &found.derived, &found.tables, &found.jobs, &found.states,
                            &found.rows, &found.newer})
    print(*lines);
  if (found.faults() > 0)
    say("{}: {} fault{} found\n", path.string(), found.faults(), found.faults() == 1 ? "" : "s");
  if (!found.file.empty())
    say("The file itself is damaged. Go back to a backup of it, or save what can still be "
        "read with SQLite's .recover (see schema/README.md); keep the file until then\n");
  // Where the file itself is damaged, a state computed again would not be safe either.
  if (!found.states.empty() && found.file.empty())
    say("A damaged checkpoint is never used; {} lets its job be computed again\n",
        command_text("retry", path));
  if (found.lacks_log)
    say("{0}: its log, {0}-wal, is not there: it was copied while a run was on, or power failed.\n"
        "Its newest rows may be missing; {1} computes them again\n"
        "A whole copy is made by: campaign backup FILE\n",
        path.string(), command_text("run", path));
  if (found.file.empty() && !(found.jobs.empty() && found.rows.empty() && found.tables.empty()))
    say("{} computes such jobs again, and puts right what differs\n",
        command_text("verify --repair", path));
  else if (found.file.empty() && !found.derived.empty())
    say("No row is lost. {} makes indexes and statistics anew\n",
        command_text("verify --repair", path));
  if (!found.newer.empty())
    say("{}: a newer program wrote some of it; update campaign\n", path.string());
  for (const std::string& why : found.unknown)
    say("{}: could not be checked to the end: {}\nThis says nothing about what is stored: "
        "once that is mended, give the same command again\n",
        path.string(), printable(why));
}

ordered_json json_of(const Findings& found, const std::string& size) {
  return {{"sound", found.empty()},       {"holds", size},
          {"faults", found.faults()},     {"file", found.file},
          {"indexes", found.derived},     {"tables", found.tables},
          {"jobs", found.jobs},           {"states", found.states},
          {"rows", found.rows},           {"newer", found.newer},
          {"not_checked", found.unknown}, {"jobs_without_digests", found.without_digests}};
}

}  // namespace

int verify(const VerifyOptions& options) {
  if (!options.recompute.empty())
    return recompute_jobs(options.store, options.recompute, options.repair, options.json);
  if (options.repair) return repair(options.store, options.json);
  const std::filesystem::path& path = options.store;
  if (!std::filesystem::exists(path)) static_cast<void>(Reader{path});  // throws: make it first
  Findings found;
  std::string size;
  try {
    const Reader store(path);
    found.lacks_log = store.lacks_log();
    const schema::Faults faults = store.faults();
    found.file = faults.file;
    found.derived = faults.derived;
    look_at_tables(store, found);
    look_at_jobs(store, found);
    size = size_text(store);
  } catch (const schema::Damage& damage) {
    found.file.emplace_back(damage.what());
  } catch (const schema::NameError&) {
    throw;
  } catch (const schema::StoreError& error) {
    found.unknown.emplace_back(error.what());
  }
  if (options.json) {
    print_json(json_of(found, size));
    return found.empty() ? exit_complete : exit_failed;
  }
  if (found.empty()) {
    say("{}: sound ({})\n", path.string(), size);
    if (found.without_digests > 0)
      say("{} of its jobs have no digest of all their rows, as a program of an older version wrote "
          "them: a flipped bit there may go unseen. {} compares them with a second computation, {} "
          "gives them one as they are\n",
          count_text(found.without_digests), command_text("verify --recompute all", path),
          command_text("verify --repair", path));
    return exit_complete;
  }
  print(found, path);
  return exit_failed;
}

}  // namespace haff::campaign
