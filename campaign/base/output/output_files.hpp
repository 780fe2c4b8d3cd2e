// SPDX-License-Identifier: GPL-3.0-or-later

// Files that are written one after another, even if one of them cannot be written.
#pragma once

#include <exception>
#include <filesystem>
#include <map>
#include <ostream>
#include <string>
#include <vector>

namespace haff::campaign {

class OutputFiles {
 public:
  // Whether `write`, which gets the path, succeeded. An exception is kept as the reason why the
  // file is missing.
  template <class Write>
  bool attempt(const std::filesystem::path& file, Write&& write) {
    try {
      write(file);
    } catch (const std::exception& error) {
      add_missing(file, error.what());
      return false;
    }
    written_.push_back(file);
    return true;
  }

  const std::vector<std::filesystem::path>& written() const { return written_; }
  bool is_complete() const { return missing_.empty(); }

  // "Missing: a.png, b.png: gnuplot is not installed ...", a line for each reason; nothing if all
  // files were written.
  void print_missing(std::ostream& report) const;

 private:
  void add_missing(const std::filesystem::path& file, std::string reason);

  std::vector<std::filesystem::path> written_;
  std::map<std::string, std::vector<std::string>> missing_;  // by reason
};

}  // namespace haff::campaign
