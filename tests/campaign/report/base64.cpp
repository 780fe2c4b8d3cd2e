// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/report/base64.hpp"

#include <doctest/doctest.h>

#include <string_view>

using namespace haff::campaign;

namespace {

std::string of(std::string_view text) {
  return base64(std::as_bytes(std::span(text)));
}

}  // namespace

TEST_CASE("base64: the test vectors of RFC 4648") {
  CHECK(of("") == "");
  CHECK(of("f") == "Zg==");
  CHECK(of("fo") == "Zm8=");
  CHECK(of("foo") == "Zm9v");
  CHECK(of("foob") == "Zm9vYg==");
  CHECK(of("fooba") == "Zm9vYmE=");
  CHECK(of("foobar") == "Zm9vYmFy");
}

TEST_CASE("base64: bytes above 127") {
  CHECK(of("\xff\xfe\x80") == "//6A");
}
