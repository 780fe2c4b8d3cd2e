// SPDX-License-Identifier: GPL-3.0-or-later

// `campaign plot`: a question of the user's own, as a picture, a table or text.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "campaign/curves/question.hpp"

namespace haff::campaign {

struct PlotOptions {
  Question question;
  bool list = false;                              // lists what can be drawn
  bool json = false;                              // the list as JSON
  std::optional<std::filesystem::path> out = {};  // .svg, .png or .csv; nothing: text
};

// Whether the file's suffix names a format.
bool is_plot_file(const std::filesystem::path& file);

// Draws, or prints a picture made of text that fits the terminal; returns an ExitCode. Throws
// QuestionError, NothingToDraw, schema::QueryError, GnuplotMissing, std::runtime_error if the file
// cannot be written, and the errors of the store.
int plot(const std::filesystem::path& store, const PlotOptions& options);

}  // namespace haff::campaign
