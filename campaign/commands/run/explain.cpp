// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/commands/run/explain.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "campaign/base/output/output.hpp"
#include "campaign/base/process/exit_code.hpp"
#include "campaign/base/text/job_text.hpp"
#include "campaign/commands/json_output.hpp"
#include "campaign/report/explanation.hpp"

namespace haff::campaign {
namespace {

void print(const char* title, const std::vector<std::string>& lines) {
  const char* head = title;
  for (const std::string& line : lines) {
    say("{:<15}{}\n", head, line);
    head = "";
  }
}

}  // namespace

int explain_job(const std::filesystem::path& path, std::int64_t job_id, bool json) {
  const Explanation found = explain(schema::Reader(path), job_id);
  if (json) {
    print_json(explanation_json(found));
    return exit_complete;
  }
  say("job {}: {}\n\n", job_id, describe(found.row.job));
  print("Where it is", found.where);
  print("Waits for", found.waits_for);
  print("What was tried", found.tried);
  print("Next", found.next);
  return exit_complete;
}

}  // namespace haff::campaign
