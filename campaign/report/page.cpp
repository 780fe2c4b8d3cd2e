// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/report/page.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <tuple>

#include "campaign/base/process/machine.hpp"
#include "campaign/base/process/version.hpp"
#include "campaign/report/assets.hpp"
#include "campaign/report/base64.hpp"
#include "campaign/report/occupancy.hpp"
#include "campaign/report/overview.hpp"
#include "campaign/report/overview_json.hpp"
#include "campaign/report/theory_table.hpp"
#include "schema/store/averaged_tables.hpp"

namespace haff::campaign {
namespace {

using nlohmann::ordered_json;

ordered_json occupancy_json(const Overview& overview) {
  ordered_json list = ordered_json::array();
  for (const Occupancy& one : occupancy(overview.jobs, overview.running))
    list.push_back({{"host", one.host}, {"time", one.time}, {"busy", one.busy}});
  return list;
}

// CPU time expected of jobs beside what they took, by gas: of those that are done, and of all.
ordered_json cost_json(const std::vector<schema::JobRow>& jobs) {
  struct Cost {
    int jobs = 0, done = 0;
    double expected = 0, expected_of_done = 0, spent_on_done = 0, spent = 0;
  };
  std::map<std::tuple<schema::Kind, int, double, std::uint32_t, double, std::string>, Cost> costs;
  for (const schema::JobRow& row : jobs) {
    Cost& cost = costs[{row.job.kind, row.job.d, row.job.n, row.job.particles,
                        row.job.e.value_or(NAN), row.job.effects.text()}];
    const double expected = row.expected_cpu_seconds.value_or(0);
    ++cost.jobs;
    cost.expected += expected;
    cost.spent += row.progress.cpu_seconds;
    if (row.status != schema::Status::done) continue;
    ++cost.done;
    cost.expected_of_done += expected;
    cost.spent_on_done += row.progress.cpu_seconds;
  }
  ordered_json list = ordered_json::array();
  for (const auto& [gas, cost] : costs) {
    const double e = std::get<4>(gas);
    list.push_back({{"kind", name(std::get<0>(gas))},
                    {"d", std::get<1>(gas)},
                    {"e", std::isnan(e) ? ordered_json(nullptr) : ordered_json(e)},
                    {"n", std::get<2>(gas)},
                    {"particles", std::get<3>(gas)},
                    {"effects", std::get<5>(gas)},
                    {"jobs", cost.jobs},
                    {"done", cost.done},
                    {"expected_cpu_seconds", cost.expected},
                    {"cpu_seconds", cost.spent},
                    {"expected_cpu_seconds_of_done", cost.expected_of_done},
                    {"cpu_seconds_of_done", cost.spent_on_done}});
  }
  return list;
}

// Which machine and which program read the store, and which wrote it.
ordered_json origin_json(const std::vector<schema::JobRow>& jobs) {
  std::map<std::pair<std::string, std::string>, int> writers;
  for (const schema::JobRow& row : jobs)
    if (row.code_version) ++writers[{*row.code_version, row.host.value_or("")}];
  ordered_json written = ordered_json::array();
  for (const auto& [writer, count] : writers)
    written.push_back({{"code_version", writer.first}, {"host", writer.second}, {"jobs", count}});
  return {{"program", version_text()},
          {"processors", processors()},
          {"memory_bytes", memory_bytes()},
          {"written_by", written}};
}

ordered_json statuses_json() {
  ordered_json list = ordered_json::array();
  for (const schema::StatusEntry& entry : schema::statuses)
    list.push_back({{"status", entry.name}, {"meaning", entry.meaning}});
  return list;
}

double seconds_since_1970() {
  const std::chrono::duration<double> now = std::chrono::system_clock::now().time_since_epoch();
  return now.count();
}

// Text as the content of an element `script`, which only "</" and "<!--" could end early.
std::string script_text(std::string_view json) {
  std::string text;
  for (const char character : json)
    if (character == '<')
      text += "\\u003c";
    else
      text += character;
  return text;
}

std::string_view asset(std::string_view name) {
  const auto found = std::ranges::find(assets(), name, &Asset::name);
  if (found == assets().end())
    throw std::logic_error("the page has no part named " + std::string(name));
  return found->bytes;
}

// The template with each {{name}} replaced. Names in what is put in are left alone.
template <class Value>
std::string filled(std::string_view text, Value&& value_of) {
  std::string page;
  for (;;) {
    const std::size_t open = text.find("{{"), close = text.find("}}", open);
    if (open == std::string_view::npos || close == std::string_view::npos) break;
    page += text.substr(0, open);
    page += value_of(text.substr(open + 2, close - open - 2));
    text.remove_prefix(close + 2);
  }
  return page.append(text);
}

}  // namespace

std::vector<std::byte> page_tables(const schema::Reader& store) {
  return schema::averaged_tables(store, {theory_table(store)});
}

std::string averages_version(const schema::Reader& store) {
  auto rows = store.query(
      "SELECT group_concat(status || ' ' || jobs || ' ' || coalesce(finished, ''), ', ') FROM "
      "(SELECT status, count(*) AS jobs, max(finished) AS finished FROM jobs GROUP BY status)");
  const auto row = rows.next();
  const auto* text = row ? std::get_if<std::string>(row->data()) : nullptr;
  return text ? *text : "";
}

std::string page_data(const schema::Reader& store) {
  const Overview overview = look(store);
  ordered_json data = overview_json(overview);
  data["read"] = seconds_since_1970();
  data["statuses"] = statuses_json();
  data["occupancy"] = occupancy_json(overview);
  data["cost"] = cost_json(overview.jobs);
  data["origin"] = origin_json(overview.jobs);
  data["averages_version"] = averages_version(store);
  return data.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

void require_page() {
  if (assets().empty())
    throw PageMissing("this program was built without the libraries of the page: " +
                      std::string(why_no_assets()) +
                      ". Without them, `campaign figures` makes a page of pictures");
}

std::string report_page(const schema::Reader& store, bool is_served) {
  require_page();
  return filled(asset("page.html"), [&](std::string_view name) -> std::string {
    if (name == "data") return script_text(page_data(store));
    if (name == "averages") return base64(page_tables(store));
    if (name == "served") return is_served ? "yes" : "no";
    if (name == "connect") return is_served ? "'self'" : "'none'";
    if (name.ends_with(".wasm")) return base64(std::as_bytes(std::span(asset(name))));
    return std::string(asset(name));
  });
}

}  // namespace haff::campaign
