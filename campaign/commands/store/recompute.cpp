// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/commands/store/recompute.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <system_error>
#include <utility>
#include <vector>

#include "campaign/base/output/output.hpp"
#include "campaign/base/process/exit_code.hpp"
#include "campaign/base/text/command_text.hpp"
#include "campaign/base/text/job_text.hpp"
#include "campaign/base/text/number_text.hpp"
#include "campaign/base/text/printable.hpp"
#include "campaign/commands/json_output.hpp"
#include "campaign/commands/store/repair.hpp"
#include "campaign/job/recomputation.hpp"

namespace haff::campaign {
namespace {

using schema::Difference;
using schema::JobRow;

// "all", a job's number, or a part of all finished jobs.
struct Choice {
  std::optional<std::int64_t> job_id = {};
  double percent = 100;
};

template <class Number>
std::optional<Number> number_in(std::string_view text) {
  Number number{};
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
  if (read.ec != std::errc() || read.ptr != text.data() + text.size()) return std::nullopt;
  return number;
}

std::optional<Choice> choice_in(const std::string& word) {
  if (word == "all") return Choice{};
  if (word.ends_with('%')) {
    const auto percent = number_in<double>(std::string_view(word).substr(0, word.size() - 1));
    if (!percent || !(*percent > 0 && *percent <= 100)) return std::nullopt;
    return Choice{.percent = *percent};
  }
  const auto job_id = number_in<std::int64_t>(word);
  if (!job_id || *job_id < 1) return std::nullopt;
  return Choice{.job_id = *job_id};
}

bool is_finished(const JobRow& row) {
  return row.status == schema::Status::done || row.status == schema::Status::collapsed;
}

// This many jobs, different ones each time, so that a few a day reach all of them in time.
void keep_some(std::vector<JobRow>& rows, double percent) {
  const auto kept =
      static_cast<std::size_t>(std::ceil(percent / 100 * static_cast<double>(rows.size())));
  std::mt19937_64 draw(
      static_cast<std::uint64_t>(std::chrono::system_clock::now().time_since_epoch().count()));
  for (std::size_t k = 0; k < kept; ++k) std::swap(rows[k], rows[k + draw() % (rows.size() - k)]);
  rows.resize(kept);
  std::ranges::sort(rows, {}, &JobRow::job_id);
}

std::vector<JobRow> chosen(const schema::Reader& store, const Choice& choice) {
  if (choice.job_id) {
    const JobRow row = store.job(*choice.job_id);
    if (!is_finished(row))
      throw schema::NameError(fmt::format(
          "{}: job {} is {}: only what is finished can be compared with a second computation",
          store.path().string(), row.job_id, name(row.status)));
    return {row};
  }
  std::vector<JobRow> rows = store.jobs();
  const auto is_given = [](const JobRow& row) {
    return row.job.kind == schema::Kind::equilibration &&
           row.job.start.kind == schema::Start::Kind::file;
  };
  std::erase_if(rows, [&](const JobRow& row) { return !is_finished(row) || is_given(row); });
  if (!rows.empty()) keep_some(rows, choice.percent);
  return rows;
}

struct Outcome {
  bool json = false;
  std::vector<std::string> notes = {};  // kept for JSON, otherwise printed at once
  std::size_t same = 0, different = 0, not_computed = 0;
  std::size_t put_right = 0;    // of those that are different
  std::size_t last_digits = 0;  // values
};

template <class... Values>
void note(Outcome& outcome, fmt::format_string<Values...> text, Values&&... values) {
  std::string line = fmt::format(text, std::forward<Values>(values)...);
  if (!outcome.json) return say("{}\n", line);
  outcome.notes.push_back(std::move(line));
}

constexpr std::size_t most_lines_per_job = 10;

void print(const std::string& job, const std::vector<Difference>& found, Outcome& outcome) {
  std::size_t lines = 0;
  for (const Difference& each : found) {
    if (each.is_in_last_digits) continue;
    if (++lines > most_lines_per_job) continue;
    const std::string place = each.row.empty() ? "" : each.row + ": ";
    const std::string what = each.column.empty() ? name(each.part) : each.column;
    note(outcome, "{}: {}{} is {} in the store, {} when computed again", job, printable(place),
         what, printable(each.here), printable(each.there));
  }
  if (lines > most_lines_per_job) note(outcome, "{}: and {} more", job, lines - most_lines_per_job);
}

// The second computation may be the one that was disturbed: it is believed if a third one, from the
// start, gives the same.
void put_right(schema::Store& store, const JobRow& row, const Recomputation& again,
               const std::string& job, Outcome& outcome) {
  const Recomputation third = recompute(store, row);
  if (!differences(again.store, again.store.job(again.job_id), third).empty()) {
    note(outcome,
         "{}: a third computation differs from the second: this machine does not compute the same "
         "twice, and nothing was changed. Have its memory tested",
         job);
    return;
  }
  const Replaced replaced = replace(store, row, again, false);
  ++outcome.put_right;
  note(outcome, "{}: a third computation is like the second; {} row{} replaced{}", job,
       replaced.rows, replaced.rows == 1 ? " is" : "s are",
       replaced.state ? ", and so is its state" : "");
}

// writer: the store in which differences are put right.
void compare(const schema::Reader& store, const JobRow& row, schema::Store* writer,
             Outcome& outcome) {
  const std::string job = fmt::format("job {} ({})", row.job_id, describe(row.job));
  try {
    const Recomputation again = recompute(store, row);
    const auto found = differences(store, row, again);
    const auto small =
        static_cast<std::size_t>(std::ranges::count_if(found, &Difference::is_in_last_digits));
    outcome.last_digits += small;
    const bool is_same = found.size() == small;
    ++(is_same ? outcome.same : outcome.different);
    print(job, found, outcome);
    if (writer != nullptr && !is_same) put_right(*writer, row, again, job, outcome);
    spdlog::debug("{}: computed again", job);
  } catch (const OtherPhysics& other) {
    ++outcome.not_computed;
    note(outcome, "{}: not computed again: it {}", job, other.what());
  } catch (const schema::Unavailable&) {
    throw;
  } catch (const std::exception& error) {
    ++outcome.different;
    note(outcome, "{}: could not be computed again: {}", job, printable(error.what()));
  }
}

// Another call would choose another part of the jobs.
std::string which_again(const std::string& which) {
  return which.ends_with('%') ? "all" : which;
}

}  // namespace

std::string fault_of_choice(const std::string& word) {
  if (choice_in(word)) return "";
  return "'" + word + "' names no jobs; expected a job's number, all, or a part such as 5%";
}

int recompute_jobs(const std::filesystem::path& path, const std::string& which, bool repair,
                   bool json) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::seconds between_reports{10};
  std::optional<schema::Store> writer;
  if (repair) writer = schema::Store::open(path);
  const schema::Reader store(path);
  const auto rows = chosen(store, choice_in(which).value());
  Outcome outcome{.json = json};
  auto reported = Clock::now();
  for (std::size_t k = 0; k < rows.size(); ++k) {
    compare(store, rows[k], writer ? &*writer : nullptr, outcome);
    if (Clock::now() - reported < between_reports) continue;
    reported = Clock::now();
    spdlog::info("{} of {} jobs computed again", k + 1, rows.size());
  }
  if (json) {
    print_json({{"computed_again", rows.size()},
                {"same", outcome.same},
                {"different", outcome.different},
                {"put_right", outcome.put_right},
                {"not_computed", outcome.not_computed},
                {"values_in_last_digits", outcome.last_digits},
                {"what", outcome.notes}});
    return outcome.different > outcome.put_right ? exit_failed : exit_complete;
  }
  if (outcome.last_digits > 0)
    say("{} values differ in the last digits of a logarithm or a transform, as they may between "
        "two machines\n",
        count_text(static_cast<std::int64_t>(outcome.last_digits)));
  if (outcome.different > 0) {
    say("{}: {} of {} finished jobs came out different: one of the two computations was "
        "disturbed{}\n",
        path.string(), outcome.different, rows.size(),
        outcome.put_right > 0 ? fmt::format("; {} put right", outcome.put_right) : "");
    if (!repair)
      say("{} computes them once more, and puts right what the store has wrong\n",
          command_text("verify --recompute " + which_again(which) + " --repair", path));
    return outcome.different > outcome.put_right ? exit_failed : exit_complete;
  }
  say("{}: {} finished job{} computed again, every bit the same{}\n", path.string(), outcome.same,
      outcome.same == 1 ? "" : "s",
      outcome.not_computed > 0
          ? fmt::format(" ({} not: another physics version)", outcome.not_computed)
          : "");
  return exit_complete;
}

}  // namespace haff::campaign
