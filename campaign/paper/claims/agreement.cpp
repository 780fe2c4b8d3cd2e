// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/paper/claims/agreement.hpp"

#include <exception>

#include "campaign/base/output/write_file.hpp"
#include "campaign/base/text/csv.hpp"
#include "campaign/paper/claims/claims.hpp"

namespace haff::campaign {

std::vector<Comparison> agreement(const Averages& averages) {
  Table table;
  for (const auto& add : {add_cooling, add_velocities, add_correlations, add_clusters}) {
    try {
      add(averages, table);
    } catch (const std::exception& error) {  // what one cannot take must not end the others
      table.push_back({.claim = "failed", .quantity = "not computed", .note = error.what()});
    }
  }
  return table;
}

void write_agreement(const std::vector<Comparison>& table, const std::filesystem::path& file) {
  std::string text = csv_row("claim", "quantity", "e", "n", "value", "half_interval_95",
                             "reference", "source", "criterion", "holds", "note");
  for (const Comparison& row : table) {
    text +=
        csv_row(row.claim, row.quantity, row.e, row.n, row.value, row.half_interval, row.reference,
                row.source, row.criterion, row.holds ? (*row.holds ? "yes" : "no") : "", row.note);
  }
  write_file(file, text);
}

}  // namespace haff::campaign
