// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/accuracy/cost/cost.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "campaign/accuracy/assessment.hpp"
#include "campaign/accuracy/cost/advice.hpp"
#include "campaign/accuracy/cost/figure.hpp"
#include "campaign/accuracy/cost/rows.hpp"
#include "campaign/accuracy/cost/tables.hpp"
#include "campaign/base/output/write_file.hpp"
#include "campaign/planning/forecast.hpp"
#include "campaign/plot/gnuplot.hpp"
#include "campaign/results/finished_runs.hpp"

namespace haff::campaign {

namespace {

constexpr std::string_view pilot_grid = R"({ "e": 0.90, "n": 0.4, "tau_max": 20, "seeds": 16,
  "grids": [ { "N": [2000, 8000, 32000] }, { "N": 8000, "equilibrate": 100 } ] })";

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw std::runtime_error(
        fmt::format("{}: folder cannot be made: {}", folder.string(), error.message()));
}

void print_files(const std::filesystem::path& out, const OutputFiles& pictures,
                 std::ostream& report) {
  fmt::print(report, "Written: {}\n", (out / "cost.csv").string());
  for (const auto& picture : pictures.written())
    fmt::print(report, "         {}\n", picture.string());
  pictures.print_missing(report);
}

void print_json(const std::vector<CostRow>& rows, const std::filesystem::path& out,
                const OutputFiles& pictures, std::ostream& report) {
  auto files = nlohmann::ordered_json::array();
  files.push_back((out / "cost.csv").string());
  for (const auto& picture : pictures.written()) files.push_back(picture.string());
  const nlohmann::ordered_json all{{"rows", json_of(rows)}, {"written", files}};
  report << all.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << '\n';
}

}  // namespace

int cost(const schema::Reader& store, const CostRequest& request, std::ostream& report) {
  const auto finished = read_finished_runs(store);
  if (finished.empty() && request.json)
    throw std::runtime_error("no cooling run is done: there is nothing to say what accuracy costs");
  if (finished.empty()) {
    fmt::print(report,
               "No cooling run is done yet. To learn what accuracy costs, plan for example\n{}\n",
               pilot_grid);
    return 1;
  }
  const Assessment assessment = assess(finished, store.targets(), asked_by(request.targets));
  Forecast forecast(store.jobs());
  const auto advised = advice(assessment, request.targets, forecast);
  const auto rows = rows_of(assessment, advised);
  if (!request.json)
    print_cost_tables(store, request.targets, finished, assessment, advised, report);

  make_folder(request.out);
  write_file(request.out / "cost.csv", csv_of(rows));
  const OutputFiles pictures = draw_cost(assessment, request.out);
  if (request.json)
    print_json(rows, request.out, pictures, report);
  else
    print_files(request.out, pictures, report);
  return pictures.is_complete() ? 0 : 1;
}

}  // namespace haff::campaign
