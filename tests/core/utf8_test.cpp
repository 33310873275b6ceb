#include "core/utf8.h"

#include <doctest/doctest.h>

#include "core/text_file.h"

using namespace vasa;

TEST_CASE("UTF-8 is told from what is not") {
  for (const char* good : {"", "aorta", "Artère", "動脈", "\xf0\x9f\xab\x80"})
    CHECK_MESSAGE(isUtf8(good), good);
  for (const char* bad : {"Art\xe8re", "\xc0\x80", "\xed\xa0\x80", "\xf4\x90\x80\x80", "a\xe2\x80", "\x80"})
    CHECK_MESSAGE(!isUtf8(bad), bad);
}

TEST_CASE("text of Windows' code page is read as what it says") {
  CHECK(utf8FromWindows("Art\xe8re de l\x92"
                        "a\xefne, \x80 5") == "Artère de l’aïne, € 5");
  std::string kept;
  const auto read = [&](std::string_view text) { return std::string(*plainText(text, "a.obj", kept)); };
  CHECK(read("o Art\xe8re\n") == "o Artère\n");
  CHECK(read("o Art\xe8re\rv 0 0 0\r") == "o Artère\nv 0 0 0\n");
  CHECK(read("o Artère\n") == "o Artère\n");
  CHECK(read("# \xa9\no Artère\n#") == "# ©\no Artère\n#");
  const std::string_view binary("LINES 1 3\n\0\0\0\2\xe8\xff", 16);  // numbers stand among the words
  CHECK(read(binary) == binary);
}
