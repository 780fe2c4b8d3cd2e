// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/commands/results/plot.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <variant>
#include <vector>

#include "campaign/base/output/output.hpp"
#include "campaign/base/output/terminal.hpp"
#include "campaign/base/process/exit_code.hpp"
#include "campaign/base/text/number_text.hpp"
#include "campaign/base/text/printable.hpp"
#include "campaign/base/text/text_table.hpp"
#include "campaign/commands/json_output.hpp"
#include "campaign/curves/answer/answer.hpp"
#include "campaign/curves/inventory.hpp"
#include "campaign/plot/picture.hpp"
#include "campaign/plot/table.hpp"
#include "campaign/plot/text_picture.hpp"
#include "campaign/results/mixed_physics.hpp"

namespace haff::campaign {
namespace {

nlohmann::ordered_json values_json(const std::vector<schema::Value>& values) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const schema::Value& value : values) {
    if (const auto* text = std::get_if<std::string>(&value)) list.push_back(*text);
    if (const auto* real = std::get_if<double>(&value)) list.push_back(*real);
    if (const auto* whole = std::get_if<std::int64_t>(&value)) list.push_back(*whole);
  }
  return list;
}

nlohmann::ordered_json list_json(const Inventory& inventory) {
  using nlohmann::ordered_json;
  const auto described = [](const std::vector<Inventory::Described>& all) {
    ordered_json list = ordered_json::array();
    for (const auto& each : all) list.push_back({{"name", each.name}, {"meaning", each.meaning}});
    return list;
  };
  ordered_json profiles = ordered_json::array(), parameters = ordered_json::array();
  for (const auto& each : inventory.profiles)
    profiles.push_back({{"name", each.name},
                        {"variable", each.variable},
                        {"meaning", each.meaning},
                        {"tau", values_json(each.taus)}});
  for (const auto& each : inventory.parameters)
    parameters.push_back({{"name", each.name}, {"values", values_json(each.values)}});
  return {{"columns", described(inventory.columns)},
          {"profiles", profiles},
          {"quantities", described(inventory.quantities)},
          {"parameters", parameters}};
}

void print_list(const Inventory& inventory) {
  TextTable columns({{"column", Align::left}, {"what", Align::left}});
  for (const auto& each : inventory.columns) columns.add({each.name, each.meaning});
  TextTable profiles({{"profile", Align::left},
                      {"of", Align::left},
                      {"what", Align::left},
                      {"at tau", Align::left}});
  for (const auto& each : inventory.profiles)
    profiles.add({each.name, each.variable, each.meaning, listed(each.taus)});
  TextTable quantities({{"quantity", Align::left}, {"what", Align::left}});
  for (const auto& each : inventory.quantities) quantities.add({each.name, each.meaning});
  TextTable parameters({{"parameter", Align::left}, {"values", Align::left}});
  for (const auto& each : inventory.parameters) parameters.add({each.name, listed(each.values)});
  say("Along a run, --against tau (or time, or an expression):\n\n{}\n", columns.text());
  if (!profiles.empty())
    say("Curves in themselves, --against their variable:\n\n{}\n", profiles.text());
  say("One number of each run, --against a parameter; of any column also pressure@20 (at this tau) "
      "and\npressure@5:15 (a mean over tau):\n\n{}\n",
      quantities.text());
  say("Parameters, for --against, --by, --where and --difference:\n\n{}", parameters.text());
}

void write(const Plot& picture, const std::filesystem::path& file) {
  if (file.extension() == ".csv")
    write_table(picture, file);
  else
    draw_picture(picture, file,
                 file.extension() == ".svg" ? PictureFormat::svg : PictureFormat::png);
}

// The caption takes lines of its own, and the prompt one.
void print_text(const Plot& picture) {
  const TerminalSize terminal = terminal_size(STDOUT_FILENO);
  const std::string caption = printable(picture.caption);
  const int width = std::max(terminal.columns, 1);
  const int below = static_cast<int>(caption.size()) / width + 4;
  constexpr int fewest = 16, most = 40;
  const TextSize size{.columns = width, .lines = std::clamp(terminal.lines - below, fewest, most)};
  print_as_is(text_picture(picture, size, shows_colours(STDOUT_FILENO)));
  say("{}\n", caption);
}

}  // namespace

bool is_plot_file(const std::filesystem::path& file) {
  const auto suffix = file.extension();
  return suffix == ".svg" || suffix == ".png" || suffix == ".csv";
}

int plot(const std::filesystem::path& path, const PlotOptions& options) {
  const schema::Reader store(path);
  if (options.list) {
    if (options.json)
      print_json(list_json(inventory_of(store)));
    else
      print_list(inventory_of(store));
    return exit_complete;
  }
  const Answer result = answer(store, options.question);
  for (const std::string& sentence : mixed_physics(store)) complain("Note: {}\n", sentence);
  for (const std::string& sentence : result.notes) complain("Note: {}\n", sentence);
  if (!options.out) {
    print_text(result.plot);
    return exit_complete;
  }
  write(result.plot, *options.out);
  say("{}\n{}\n", options.out->string(), result.plot.caption);
  return exit_complete;
}

}  // namespace haff::campaign
