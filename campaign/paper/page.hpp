// The page that shows all figures with their captions, beside what is published, and how far
// theory and paper agree: one HTML file next to the pictures.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "campaign/paper/agreement.hpp"

namespace haff::campaign {

struct FigureEntry {
  int id = 0;
  std::string title = {};
  std::string picture = {};    // file name, beside the page; empty: not drawn
  std::string caption = {};    // or, not drawn, why
  std::string published = {};  // what the paper shows there
};

// Throws std::runtime_error if it cannot be written.
void write_page(const std::vector<FigureEntry>& figures, const std::vector<Comparison>& table,
                const std::filesystem::path& file);

}  // namespace haff::campaign
