#include "core/text_file.h"

#include <doctest/doctest.h>

#include "core/atomic_file.h"
#include "io/csv.h"
#include "io/stl.h"
#include "support/shared_data.h"

using namespace vasa;

TEST_CASE("text of a file: a byte order mark left out, lines that end with line feeds") {
  const auto plain = [](std::string_view text) {
    std::string kept;
    const auto read = plainText(text, "a", kept);
    if (!read.ok()) FAIL(read.error().message);
    return std::string(*read);
  };
  CHECK(plain("") == "");
  CHECK(plain("\xEF\xBB\xBF"
              "a\r\nb\n") == "a\r\nb\n");
  CHECK(plain("a\rb\r\rc") == "a\nb\n\nc");
  CHECK(plain("a\rb\nc") == "a\rb\nc");  // a carriage return among line feeds is a blank
}

TEST_CASE("UTF-16 is known with and without its mark, in both orders") {
  for (const std::string& text : {std::string("\xFF\xFE"), std::string("\xFE\xFF\0a", 4),
                                  std::string("a\0b\0", 4), std::string("\0a\0b", 4)}) {
    CHECK(isUtf16(text));
    std::string kept;
    const auto read = plainText(text, "a.txt", kept);
    REQUIRE(!read.ok());
    CHECK(read.error().fault == Fault::badInput);
    CHECK(read.error().message.starts_with("a.txt: the text is UTF-16; save it as UTF-8"));
  }
  for (const std::string& text : {std::string("ab"), std::string(80, '\0'), std::string("a\0\0\0", 4)})
    CHECK(!isUtf16(text));
}

TEST_CASE("tables with carriage returns, and in UTF-16") {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "a.csv";
  REQUIRE(writeFileAtomically(path, std::string("\xEF\xBB\xBFname,x\rp,1\rq,z\r")).ok());
  auto table = csv::Table::read(path);
  REQUIRE(table.ok());
  REQUIRE(table->rowCount() == 2);
  CHECK(table->number(0, "x") == 1);
  table->number(1, "x");
  CHECK(table->state().error().message == "a.csv:3: 'z' is not a number");
  REQUIRE(writeFileAtomically(path, std::string("\xFF\xFEn\0", 4)).ok());
  CHECK(csv::Table::read(path).error().message.starts_with("a.csv: the text is UTF-16"));
}

TEST_CASE("what stands in a file's place is named, with what to do") {
  std::string kept;
  for (const auto& [bytes, told] :
       {std::pair("\x1f\x8b\x08", "it is packed by gzip; unpack it first"),
        std::pair("version https://git-lfs.github.com/spec/v1\noid", "it is a pointer of Git LFS; fetch"),
        std::pair("\n <!DOCTYPE html>\n<html>", "it is a web page, saved in place of the file; download")}) {
    const auto read = plainText(bytes, "a.swc", kept);
    REQUIRE(!read.ok());
    CHECK_MESSAGE(read.error().message.starts_with("a.swc: " + std::string(told)), read.error().message);
    const auto text = std::string_view(bytes);
    const auto stl = parseStl(std::as_bytes(std::span(text)), "a.stl", {});
    REQUIRE(!stl.ok());
    CHECK_MESSAGE(stl.error().message.starts_with("a.stl: " + std::string(told)), stl.error().message);
  }
  CHECK(!otherContent("solid <html>"));
}
