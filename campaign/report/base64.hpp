// SPDX-License-Identifier: GPL-3.0-or-later

// Bytes as text (RFC 4648), by which a page carries a file.
#pragma once

#include <span>
#include <string>

namespace haff::campaign {

std::string base64(std::span<const std::byte> bytes);

}  // namespace haff::campaign
