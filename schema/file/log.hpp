// SPDX-License-Identifier: GPL-3.0-or-later

// The write-ahead log beside a store that is in use.
#pragma once

#include <cstdint>

namespace haff::schema {

struct LogSize {
  std::int64_t bytes = 0;  // of the file
  bool is_copied = true;   // all that it holds is in the store: it begins anew with the next commit
};

}  // namespace haff::schema
