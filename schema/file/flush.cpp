// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/file/flush.hpp"

#include <fcntl.h>
#include <unistd.h>

namespace haff::schema {

bool flush_to_disk(const std::filesystem::path& file_or_folder) {
  const int opened = ::open(file_or_folder.c_str(), O_RDONLY | O_CLOEXEC);
  if (opened < 0) return false;
  const bool is_flushed = fsync(opened) == 0;
  close(opened);
  return is_flushed;
}

}  // namespace haff::schema
