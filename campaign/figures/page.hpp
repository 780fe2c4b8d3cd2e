// SPDX-License-Identifier: GPL-3.0-or-later

// The page that shows all figures with their captions, the paper's beside what is published and how
// far theory and paper agree: one HTML file next to the pictures.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "campaign/paper/claims/agreement.hpp"

namespace haff::campaign {

struct FigureEntry {
  std::string name = {};  // of its files
  std::string title = {};
  std::string picture = {};    // file name, beside the page; empty: not drawn
  int width = 640;             // of the picture [pixels]
  std::string table = {};      // a file name likewise, CSV
  std::string caption = {};    // or, not drawn, why
  std::string published = {};  // what the paper shows there
};

struct Page {
  std::vector<FigureEntry> paper = {};
  std::vector<std::string> lacking = {};  // of the paper's figures those that the store lacks
  std::vector<Comparison> agreement = {};
  std::vector<FigureEntry> gases = {};
  std::vector<std::string> from_before = {};  // files of an earlier run, in the same folder
};

// Throws std::runtime_error if it cannot be written.
void write_page(const Page& page, const std::filesystem::path& file);

}  // namespace haff::campaign
