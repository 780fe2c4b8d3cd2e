// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/commands/revision_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <tuple>
#include <vector>

#include "campaign/accuracy/targets/targets.hpp"
#include "campaign/base/text/job_text.hpp"
#include "campaign/base/text/number_text.hpp"
#include "campaign/base/text/text_table.hpp"

namespace haff::campaign {
namespace {

using nlohmann::ordered_json;
using schema::Dismissal;
using schema::Fate;

// At most this many of the jobs that stay as they are are named; the table counts them all.
constexpr std::size_t most_named = 20;

const char* name(Fate fate) {
  switch (fate) {
    case Fate::removed:
      return "removed";
    case Fate::ends:
      return "ends";
    case Fate::kept:
      return "kept";
    case Fate::held:
      return "held";
  }
  return "";
}

std::vector<Dismissal> all_jobs(const schema::Revision& revision) {
  std::vector<Dismissal> jobs = revision.jobs;
  jobs.insert(jobs.end(), revision.shortened.begin(), revision.shortened.end());
  return jobs;
}

std::string table_text(const std::vector<Dismissal>& jobs) {
  struct Group {
    schema::Job job;
    long long jobs = 0, samples = 0;
    double bytes = 0;
  };
  std::map<std::tuple<Fate, schema::Kind, int, std::optional<double>, double, std::uint32_t>, Group>
      groups;
  for (const Dismissal& each : jobs) {
    const schema::Job& job = each.row.job;
    Group& group = groups[{each.fate, job.kind, job.d, job.e, job.n, job.particles}];
    group.job = job;
    ++group.jobs;
    group.samples += each.samples;
    group.bytes += static_cast<double>(each.bytes);
  }
  TextTable table({{"", Align::left},
                   {"kind", Align::left},
                   {"d"},
                   {"e"},
                   {"n"},
                   {"N"},
                   {"jobs"},
                   {"samples"},
                   {"states"}});
  for (const auto& [key, group] : groups)
    table.add({name(std::get<Fate>(key)), std::string(name(group.job.kind)),
               count_text(group.job.d), e_text(group.job), number_text(group.job.n),
               count_text(group.job.particles), count_text(group.jobs), count_text(group.samples),
               group.bytes > 0 ? bytes_text(group.bytes) : no_value});
  return table.text();
}

std::string sentence(const Dismissal& each) {
  const std::string job = fmt::format("job {} ({})", each.row.job_id, describe(each.row.job));
  if (each.fate == Fate::ends)
    return fmt::format("{} {}: it ends at tau = {}\n", job, each.why, number_text(each.tau_max));
  return fmt::format("{} {}\n", job, each.why);
}

}  // namespace

std::int64_t count(const schema::Revision& revision, Fate fate) {
  const auto jobs = all_jobs(revision);
  return std::ranges::count(jobs, fate, &Dismissal::fate);
}

std::string revision_text(const schema::Revision& revision) {
  const auto jobs = all_jobs(revision);
  if (jobs.empty() && revision.targets.empty()) return "";
  std::string text = jobs.empty() ? "" : table_text(jobs) + '\n';
  for (const Fate fate : {Fate::ends, Fate::kept, Fate::held}) {
    std::size_t named = 0;
    for (const Dismissal& each : jobs) {
      if (each.fate != fate) continue;
      if (fate == Fate::held || ++named <= most_named) text += sentence(each);
    }
    if (named > most_named)
      text += fmt::format("and {} more that {}\n", named - most_named,
                          fate == Fate::ends ? "end earlier" : "are kept");
  }
  for (const schema::Target& target : revision.targets)
    text +=
        fmt::format("The target {} goes, too: run would plan such jobs again\n", describe(target));
  return text;
}

ordered_json revision_json(const schema::Revision& revision) {
  ordered_json jobs = ordered_json::array(), targets = ordered_json::array();
  for (const Dismissal& each : all_jobs(revision))
    jobs.push_back({{"job_id", each.row.job_id},
                    {"job", describe(each.row.job)},
                    {"fate", name(each.fate)},
                    {"why", each.why},
                    {"tau_max", each.tau_max},
                    {"samples", each.samples},
                    {"state_bytes", each.bytes}});
  for (const schema::Target& target : revision.targets)
    targets.push_back({{"series", target.series}, {"target", describe(target)}});
  ordered_json object;
  for (const Fate fate : {Fate::removed, Fate::ends, Fate::kept, Fate::held})
    object[name(fate)] = count(revision, fate);
  object["jobs"] = std::move(jobs);
  object["targets"] = std::move(targets);
  return object;
}

}  // namespace haff::campaign
