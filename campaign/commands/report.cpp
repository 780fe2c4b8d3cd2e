#include "campaign/commands/report.hpp"

#include <fmt/format.h>

#include "campaign/base/exit_code.hpp"
#include "campaign/base/number_text.hpp"
#include "campaign/base/output.hpp"
#include "campaign/base/write_file.hpp"
#include "campaign/report/page.hpp"

namespace haff::campaign {

int report(const ReportOptions& options) {
  const std::string page = report_page(schema::Reader(options.store), false);
  std::filesystem::create_directories(options.out);
  const std::filesystem::path file = options.out / "report.html";
  write_file(file, page);
  say("{}: {}; open it in a browser, with or without a network\n", file.string(),
      bytes_text(static_cast<double>(page.size())));
  return exit_complete;
}

}  // namespace haff::campaign
