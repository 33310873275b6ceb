#include "core/atomic_file.h"

#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "support/shared_data.h"

using namespace vasa;

namespace {

std::size_t filesIn(const std::filesystem::path& folder) {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++count;
  return count;
}

}  // namespace

TEST_CASE("a file appears whole, replacing what was there") {
  test::TemporaryFolder folder;
  const auto path = folder.path() / "a.txt";
  REQUIRE(writeFileAtomically(path, std::string("first")).ok());
  REQUIRE(writeFileAtomically(path, std::string("second")).ok());
  const auto bytes = readFile(path);
  REQUIRE(bytes.ok());
  CHECK(std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()) == "second");
  CHECK(filesIn(folder.path()) == 1);
}

TEST_CASE("a file that is not committed leaves nothing and keeps the old content") {
  test::TemporaryFolder folder;
  const auto path = folder.path() / "a.txt";
  REQUIRE(writeFileAtomically(path, std::string("old")).ok());
  {
    auto file = AtomicFile::create(path);
    REQUIRE(file.ok());
    REQUIRE(file->write(std::as_bytes(std::span("new", 3))).ok());
    CHECK(filesIn(folder.path()) == 2);
  }
  CHECK(filesIn(folder.path()) == 1);
  CHECK(readFile(path)->size() == 3);
}

TEST_CASE("the emergency clean-up removes files in progress") {
  test::TemporaryFolder folder;
  auto file = AtomicFile::create(folder.path() / "a.txt");
  REQUIRE(file.ok());
  removeUnfinishedFiles();
  CHECK(filesIn(folder.path()) == 0);
}

TEST_CASE("a full disk is told, with the remedy") {
  const auto result = writeFileAtomically("/dev/full", std::string(100000, 'x'));
  REQUIRE(!result.ok());
  CHECK(result.error().fault == Fault::io);
  CHECK(result.error().message == "/dev/full: cannot write: No space left on device; free some space or write elsewhere");
}

TEST_CASE("an absent folder is told") {
  test::TemporaryFolder folder;
  const auto result = writeFileAtomically(folder.path() / "no" / "a.txt", std::string("x"));
  REQUIRE(!result.ok());
  CHECK(result.error().message.find("create the folder first") != std::string::npos);
}

TEST_CASE("reading refuses what is no regular file, at once") {
  test::TemporaryFolder folder;
  const auto pipe = folder.path() / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  for (const auto& path : {pipe, folder.path(), std::filesystem::path("/dev/zero")}) {
    const auto result = readFile(path);
    REQUIRE(!result.ok());
    CHECK(result.error().fault == Fault::io);
    CHECK(result.error().message.find("is not a regular file") != std::string::npos);
  }
  CHECK(readFile(folder.path() / "absent").error().message.find("No such file") != std::string::npos);
}

TEST_CASE("a file over the limit is refused as bad input") {
  test::TemporaryFolder folder;
  const auto path = folder.path() / "big";
  REQUIRE(writeFileAtomically(path, std::string(100, 'x')).ok());
  const auto result = readFile(path, 99);
  REQUIRE(!result.ok());
  CHECK(result.error().fault == Fault::badInput);
}
