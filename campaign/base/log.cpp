#include "campaign/base/log.hpp"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

namespace haff::campaign {

void set_up_log(bool verbose) {
  auto log = spdlog::stderr_color_st("campaign");
  log->set_pattern("%T %^%l%$ %v");
  log->set_level(verbose ? spdlog::level::debug : spdlog::level::info);
  spdlog::set_default_logger(log);
}

}  // namespace haff::campaign
