// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/base/output/write_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <stdexcept>
#include <system_error>

namespace haff::campaign {

void write_file(const std::filesystem::path& file, std::string_view content) {
  const auto fail = [&](int reason) {
    throw std::runtime_error(
        fmt::format("{}: cannot be written: {}", file.string(),
                    std::error_code(reason, std::generic_category()).message()));
  };
  std::FILE* out = std::fopen(file.c_str(), "wb");
  if (out == nullptr) fail(errno);
  // A full disk may be noticed as late as when the file is closed.
  int reason = std::fwrite(content.data(), 1, content.size(), out) == content.size() ? 0 : errno;
  if (std::fclose(out) != 0 && reason == 0) reason = errno;
  if (reason == 0) return;
  std::error_code ignored;
  std::filesystem::remove(file, ignored);
  fail(reason);
}

}  // namespace haff::campaign
