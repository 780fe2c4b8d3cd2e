// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/commands/store/cancel.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <system_error>

#include "campaign/base/output/output.hpp"
#include "campaign/base/process/exit_code.hpp"
#include "campaign/base/text/command_text.hpp"
#include "campaign/base/text/number_text.hpp"
#include "campaign/commands/choosing.hpp"
#include "campaign/commands/json_output.hpp"
#include "campaign/commands/revision_text.hpp"
#include "campaign/run/abandoned.hpp"
#include "schema/store/planning/revision.hpp"

namespace haff::campaign {
namespace {

using schema::Fate;

struct Result {
  schema::Revision revision;
  std::optional<double> freed;  // [bytes]; nothing: another program uses the store
  std::string trouble;          // why the file could not be made smaller; empty: no trouble
};

double size_of(const std::filesystem::path& file) {
  std::error_code none;
  const auto bytes = std::filesystem::file_size(file, none);
  return none ? 0 : static_cast<double>(bytes);
}

Result look(const CancelOptions& options) {
  const schema::Reader store(options.store);
  return {.revision = revision_of_cancel(store, choice_of(store, options.where), options.with_rows),
          .freed = {},
          .trouble = {}};
}

Result act(const CancelOptions& options) {
  schema::Revised store(schema::Store::open(options.store));
  take_back_from_the_dead(store);
  const schema::Choice choice = choice_of(store, options.where);
  Result result{.revision = store.cancel(choice, options.with_rows), .freed = 0.0, .trouble = {}};
  if (!options.with_rows || count(result.revision, Fate::removed) == 0) return result;
  const double before = size_of(options.store);
  try {
    if (store.give_back_space())
      result.freed = before - size_of(options.store);
    else
      result.freed.reset();
  } catch (const schema::StoreError& error) {  // the jobs are gone nevertheless
    result.trouble = error.what();
  }
  return result;
}

std::string jobs_text(std::int64_t count) {
  return fmt::format("{} job{}", count, count == 1 ? "" : "s");
}

std::string summary_text(const CancelOptions& options, const Result& result) {
  const auto removed = count(result.revision, Fate::removed);
  const auto ended = count(result.revision, Fate::ends);
  const auto kept = count(result.revision, Fate::kept), held = count(result.revision, Fate::held);
  const char* would = options.dry_run ? "would be " : "";
  std::string text = fmt::format("{} {}removed", jobs_text(removed), would);
  if (ended > 0) text += fmt::format(", {} {}ended where stored", ended, would);
  if (kept > 0)
    text +=
        fmt::format(", {} kept{}", kept, options.with_rows ? "" : " (--delete removes the done)");
  if (held > 0) text += fmt::format(", {} held and left alone", held);
  return text + ".\n";
}

void print(const CancelOptions& options, const Result& result) {
  say("{}{}", revision_text(result.revision), summary_text(options, result));
  if (options.dry_run) {
    say("Nothing was changed.\n");
    return;
  }
  if (!result.trouble.empty())
    say("The file could not be made smaller: {}. What is stored next uses the space\n",
        result.trouble);
  else if (!result.freed)
    say("Another program uses the store: the file stays as large as it is, and what is stored next "
        "uses the space\n");
  else if (*result.freed > 0)
    say("{} given back to the disk.\n", bytes_text(*result.freed));
  if (count(result.revision, Fate::ends) > 0)
    say("Next: {} completes the jobs that end where they are stored\n",
        command_text("run", options.store));
}

nlohmann::ordered_json json_of(const CancelOptions& options, const Result& result) {
  nlohmann::ordered_json object = revision_json(result.revision);
  object["dry_run"] = options.dry_run;
  object["bytes_given_back"] = nullptr;
  if (result.freed && result.trouble.empty()) object["bytes_given_back"] = *result.freed;
  return object;
}

}  // namespace

int cancel(const CancelOptions& options) {
  const Result result = options.dry_run ? look(options) : act(options);
  if (options.json)
    print_json(json_of(options, result));
  else
    print(options, result);
  const bool is_done = count(result.revision, Fate::held) == 0 && result.trouble.empty();
  return is_done ? exit_complete : exit_failed;
}

}  // namespace haff::campaign
