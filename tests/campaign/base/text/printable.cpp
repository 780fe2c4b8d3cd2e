// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/base/text/printable.hpp"

#include <doctest/doctest.h>

using namespace haff::campaign;

TEST_CASE("printable: text of any language stays as it is") {
  CHECK(printable("τ_c of Kawahara – 0.80 ± 0.01 σ 冷却 😀") ==
        "τ_c of Kawahara – 0.80 ± 0.01 σ 冷却 😀");
  CHECK(printable("").empty());
}

TEST_CASE("printable: control characters are shown, not sent") {
  CHECK(printable("a\nb\tc\x1b[2J\x7f") == "a\\x0ab\\x09c\\x1b[2J\\x7f");
  CHECK(printable(std::string_view("\0", 1)) == "\\x00");
  CHECK(printable("\u009b2J") == "\\xc2\\x9b2J");  // C1: an escape sequence in one character
  CHECK(printable("\u202egnp.exe") == "\\xe2\\x80\\xaegnp.exe");  // right to left
  CHECK(printable("\u2028") == "\\xe2\\x80\\xa8");
}

TEST_CASE("printable: bytes that are not UTF-8 are shown one by one") {
  CHECK(printable("\xff") == "\\xff");
  CHECK(printable("\xc3") == "\\xc3");                             // cut off
  CHECK(printable("\xc0\xaf") == "\\xc0\\xaf");                    // overlong
  CHECK(printable("\xed\xa0\x80") == "\\xed\\xa0\\x80");           // a surrogate
  CHECK(printable("\xf4\x90\x80\x80") == "\\xf4\\x90\\x80\\x80");  // beyond Unicode
  CHECK(printable("\xe2\x28\xa1") == "\\xe2(\\xa1");
}

TEST_CASE("printable: text in XML cannot be a tag, an entity or the end of an attribute") {
  CHECK(xml_escaped("</title><script>\"&'") == "&lt;/title&gt;&lt;script&gt;&quot;&amp;&#39;");
  CHECK(xml_escaped("\x01") == "\\x01");
}

TEST_CASE("printable: line ends are kept where this is asked for") {
  CHECK(printable_lines("one\ntwo\x1b\n") == "one\ntwo\\x1b\n");
  CHECK(printable_lines("one") == "one");
}
