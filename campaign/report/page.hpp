// SPDX-License-Identifier: GPL-3.0-or-later

// The page of `campaign report`: one HTML file that needs nothing else, neither a network nor a
// program beside the browser.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "schema/store/store.hpp"

namespace haff::campaign {

// The program was built without the libraries of the page. The message says what to install.
struct PageMissing : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Throws PageMissing if the program has no page.
void require_page();

// What changes while a run is on, as JSON: where the campaign stands (overview_json), and the rest
// of what the page's first part shows.
std::string page_data(const schema::Reader& store);

// The averaged tables of the store, with the table `theory` beside them (theory_table.hpp), as an
// SQLite file.
std::vector<std::byte> page_tables(const schema::Reader& store);

// Changes when the averaged tables of the store do.
std::string averages_version(const schema::Reader& store);

// The whole page. `is_served`: it asks its server for page_data again and again.
// Throws PageMissing.
std::string report_page(const schema::Reader& store, bool is_served);

}  // namespace haff::campaign
