// SPDX-License-Identifier: GPL-3.0-or-later

// `campaign report`: the store as a page to look at.
#pragma once

#include <filesystem>

namespace haff::campaign {

struct ReportOptions {
  std::filesystem::path store;
  std::filesystem::path out = "report";  // folder, made if it is not there
  bool serve = false;                    // on this machine, instead of writing it
  int port = 0;                          // 0: any that is free
};

// Writes out/report.html, or serves the page until a signal asks to stop; returns an ExitCode.
int report(const ReportOptions& options);

}  // namespace haff::campaign
