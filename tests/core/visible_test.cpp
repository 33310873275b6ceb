#include "core/visible.h"

#include <doctest/doctest.h>

using namespace vasa;

TEST_CASE("what steers a terminal or ends a line stands there in words, letters of any script stay") {
  CHECK(visible("aorta") == "aorta");
  CHECK(visible("a\nerror: b\tc\r") == "a\\nerror: b\\tc\\r");
  CHECK(visible("\x1b[2J\x07\x7f") == "\\x1b[2J\\x07\\u007f");
  CHECK(visible(std::string_view("a\0b", 3)) == "a\\x00b");
  CHECK(visible("Arteria vertebrális 椎骨 🫀") == "Arteria vertebrális 椎骨 🫀");
  CHECK(visible("\xc2\x9b"
                "31m") == "\\u009b31m");  // the control sequence introducer in one character
  CHECK(visible("a\xe2\x80\xae"
                "b\xe2\x81\xa6") == "a\\u202eb\\u2066");  // from right to left
  CHECK(visible("\xe2\x80\xa8") == "\\u2028");
}

TEST_CASE("bytes that are no UTF-8 stand there in words") {
  CHECK(visible("\xff") == "\\xff");
  CHECK(visible("a\x9b"
                "b") == "a\\x9bb");
  CHECK(visible("\xc3") == "\\xc3");           // cut short
  CHECK(visible("\xc0\x9b") == "\\xc0\\x9b");  // longer than needed
  CHECK(visible("\xe0\x82\x9b") == "\\xe0\\x82\\x9b");
  CHECK(visible("\xed\xa0\x80") == "\\xed\\xa0\\x80");  // a surrogate
  CHECK(visible("\xf5\x80\x80\x80") == "\\xf5\\x80\\x80\\x80");
}

TEST_CASE("of several lines, line ends and tabs stay") {
  CHECK(visibleLines("a\tb\nc\x1b\r\n") == "a\tb\nc\\x1b\\r\n");
}
