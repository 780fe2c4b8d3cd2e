// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/base/output/output_files.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include "campaign/base/text/printable.hpp"

namespace haff::campaign {

void OutputFiles::add_missing(const std::filesystem::path& file, std::string reason) {
  const std::string name = file.string() + ": ";
  if (reason.starts_with(name)) reason.erase(0, name.size());  // one reason serves many files
  missing_[reason].push_back(file.string());
}

void OutputFiles::print_missing(std::ostream& report) const {
  for (const auto& [reason, files] : missing_)
    fmt::print(report, "Missing: {}: {}\n", printable(fmt::format("{}", fmt::join(files, ", "))),
               printable(reason));
}

}  // namespace haff::campaign
