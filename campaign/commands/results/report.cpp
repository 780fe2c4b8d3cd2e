// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/commands/results/report.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "campaign/base/output/output.hpp"
#include "campaign/base/output/write_file.hpp"
#include "campaign/base/process/exit_code.hpp"
#include "campaign/base/process/signals.hpp"
#include "campaign/base/text/number_text.hpp"
#include "campaign/report/page.hpp"
#include "campaign/report/server.hpp"

namespace haff::campaign {
namespace {

int write(const ReportOptions& options) {
  const std::string page = report_page(schema::Reader(options.store), false);
  std::filesystem::create_directories(options.out);
  const std::filesystem::path file = options.out / "report.html";
  write_file(file, page);
  say("{}: {}; open it in a browser, with or without a network\n", file.string(),
      bytes_text(static_cast<double>(page.size())));
  return exit_complete;
}

int serve(const ReportOptions& options) {
  note_stop_signals();
  serve_report(options.store, options.port, [&](const std::string& address) {
    say("{}\nThis address is for you alone: any browser that has it can read {}. Ctrl-C ends it.\n",
        address, options.store.string());
    std::fflush(stdout);
  });
  return exit_complete;
}

}  // namespace

int report(const ReportOptions& options) {
  require_page();
  return options.serve ? serve(options) : write(options);
}

}  // namespace haff::campaign
