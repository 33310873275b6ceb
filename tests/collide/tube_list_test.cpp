#include "collide/tube_list.h"

#include <doctest/doctest.h>

#include "core/atomic_file.h"
#include "support/shared_data.h"
#include "support/tube_network.h"

using namespace vasa;

namespace {

std::string numbers(int count, const std::string& each = "1") {
  std::string text;
  for (int k = 0; k < count; ++k) text += each + " ";
  return text;
}

// The message with the path taken off, or "" where the text is accepted.
std::string faultOf(const std::string& text) {
  test::TemporaryFolder folder;
  const auto path = folder.path() / "t.txt";
  REQUIRE(writeFileAtomically(path, text).ok());
  const auto list = readTubeList(path);
  if (list) return "";
  CHECK(list.error().fault == Fault::badInput);
  return list.error().message.substr(list.error().message.find("t.txt"));
}

}  // namespace

TEST_CASE("what is written comes back") {
  test::TemporaryFolder folder;
  const TubeList made = test::makeTubeNetwork(50, 4);
  CHECK(made.poses[0].size() == 50);
  REQUIRE(writeTubeList(folder.path() / "t.txt", made).ok());
  const auto read = readTubeList(folder.path() / "t.txt");
  REQUIRE(read.ok());
  for (int pose : {0, 1})
    for (std::size_t i = 0; i < 50; ++i)
      CHECK(read->poses[std::size_t(pose)][i].b == made.poses[std::size_t(pose)][i].b);
  CHECK(read->excluded == made.excluded);
}

TEST_CASE("an empty list, Windows line ends and a missing last line end are fine") {
  CHECK(faultOf("0 0\n") == "");
  CHECK(faultOf("1 0\r\n" + numbers(32) + "\r\n\r\n") == "");
  CHECK(faultOf("2 1\n" + numbers(32) + "\n" + numbers(32) + "\n0 1") == "");
}

TEST_CASE("every fault names file, line, cause and remedy") {
  const std::string tube = numbers(32) + "\n";
  CHECK(faultOf("") ==
        "t.txt:1: the file ends where its first line `n m` should be: number of tubes, number of excluded "
        "pairs");
  CHECK(faultOf("one\n") == "t.txt:1: expected `n m`: number of tubes, number of excluded pairs");
  CHECK(faultOf("-1 0\n") == "t.txt:1: expected `n m`: number of tubes, number of excluded pairs");
  CHECK(
      faultOf("4000000000 7\n" + tube) ==
      "t.txt:1: 4000000000 tubes and 7 pairs are announced, more than the file can hold; correct the counts");
  CHECK(faultOf("2 0\n" + numbers(32, "1.00") + "\n") ==
        "t.txt:3: the file ends where tube 1 of 2 should be; correct the count or add the lines");
  CHECK(faultOf("1 0\n" + numbers(31, "1.5") + "\n").find("t.txt:2: 31 numbers; a tube needs 32") == 0);
  CHECK(faultOf("1 0\n" + numbers(33) + "\n").find("t.txt:2: more than 32 numbers") == 0);
  CHECK(faultOf("1 0\n" + numbers(5) + "x " + numbers(26) + "\n").find("t.txt:2: number 6 is unreadable") ==
        0);
  CHECK(faultOf("1 0\n" + numbers(32, "nan") + "\n").find("t.txt:2: number 1 is not a finite number") == 0);
  CHECK(faultOf("1 0\n" + numbers(32, "1e7") + "\n")
            .find("t.txt:2: number 1 is not a finite number of at most 1e6") == 0);
  CHECK(
      faultOf("1 0\n" + numbers(32, "1e99") + "\n").find("t.txt:2: number 1 is unreadable or out of range") ==
      0);
  CHECK(faultOf("1 0\n" + numbers(3) + "-0.2 " + numbers(28) + "\n")
            .find("t.txt:2: radius -0.200000 must be positive") == 0);
  CHECK(faultOf("1 1\n" + tube + "0 1\n") == "t.txt:3: tube 1 does not exist; the list has tubes 0 to 0");
  CHECK(faultOf("1 1\n" + tube + "0 0\n").find("t.txt:3: tube 0 is paired with itself") == 0);
  CHECK(faultOf("1 1\n" + tube + "0 -1\n") == "t.txt:3: expected two tube numbers `i j`");
  CHECK(faultOf("1 0\n" + tube + "5 6\n") ==
        "t.txt:3: text after the last announced line; correct the counts");
  CHECK(faultOf("1 1\n" + numbers(32, "1.00") + "\n") ==
        "t.txt:3: the file ends where excluded pair 0 of 1 should be; correct the count or add the lines");
}

TEST_CASE("a file that is not there is an io fault") {
  const auto list = readTubeList("/nonexistent/t.txt");
  REQUIRE(!list.ok());
  CHECK(list.error().fault == Fault::io);
}
