#include "io/bvh.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "core/atomic_file.h"
#include "io/reading.h"
#include "support/shared_data.h"

using namespace vasa;
using namespace vasa::test;

namespace {

const std::string kHierarchy =
    "HIERARCHY\nROOT Hips\n{\n OFFSET 0 1 0\n CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"
    " JOINT Left Leg \n {\n  OFFSET 0 -1 0\n  CHANNELS 3 Zrotation Xrotation Yrotation\n  End Site\n  {\n   OFFSET 0 -2 0\n  }\n }\n}\n";

void expectBvhFault(const std::string& text, const char* message) {
  expectFault(parseBvh(text, "a.bvh"), message);
}

}  // namespace

TEST_CASE("BVH: hierarchy, places, rotations in the order of the channels") {
  const auto motion = parseBvh(
      kHierarchy + "MOTION\r\nFrames: 2\nFrame Time: .0333333\n1 2 3 0 0 0 0 0 0\n1 2 3 90 0 0 0 90 90\n",
      "a.bvh");
  if (!motion.ok()) FAIL(motion.error().message);
  REQUIRE(motion->joints.size() == 2);
  CHECK(motion->joints[0].name == "Hips");
  CHECK(motion->joints[1].name == "Left Leg");
  CHECK(motion->joints[1].parent.value == 0);
  CHECK(motion->joints[1].endOffset == vec3(0, -2, 0));
  CHECK(motion->joints[0].moves);
  CHECK(!motion->joints[1].moves);
  CHECK(motion->frameCount == 2);
  CHECK(motion->framesPerSecond == 30);
  CHECK(motion->translation(1, 0) == vec3(1, 2, 3));
  CHECK(motion->translation(1, 1) == vec3(0, -1, 0));
  CHECK(glm::distance(motion->rotation(1, 0) * vec3(1, 0, 0), vec3(0, 1, 0)) < 1e-6f);
  // First about y, then about x as the file writes it: z -> x -> x.
  CHECK(glm::distance(motion->rotation(1, 1) * vec3(0, 0, 1), vec3(1, 0, 0)) < 1e-6f);
}

TEST_CASE("frame times that are rounded mean whole rates, those of film and NTSC their own") {
  const auto rateOf = [](const char* seconds) {
    const auto motion =
        parseBvh(kHierarchy + "MOTION\nFrames: 1\nFrame Time: " + seconds + "\n1 2 3 0 0 0 0 0 0\n", "a.bvh");
    REQUIRE(motion.ok());
    return double(motion->framesPerSecond);
  };
  for (const auto& each : {std::pair(".0333333", 30.0),
                           {".0333", 30.0},
                           {".00833", 120.0},
                           {".041667", 24.0},
                           {".04", 25.0},
                           {".0333667", 29.97003},
                           {".0417083", 23.97602},
                           {".0041667", 240.0},
                           {".7", 1 / 0.7}})
    CHECK_MESSAGE(rateOf(each.first) == doctest::Approx(each.second).epsilon(1e-6), each.first);
}

TEST_CASE("keywords with blanks before their colons") {
  const auto read =
      parseBvh(kHierarchy + "MOTION\nFrames : 1\nFrame Time : 0.1\n1 2 3 4 5 6 7 8 9\n", "a.bvh");
  if (!read.ok()) FAIL(read.error().message);
  CHECK(read->frameCount == 1);
}

TEST_CASE("keywords and channels in any case") {
  std::string text = kHierarchy + "MOTION\nFrames: 1\nFrame Time: .1\n1 2 3 0 0 0 0 0 0\n";
  for (char& c : text) c = char(std::toupper(static_cast<unsigned char>(c)));
  const auto motion = parseBvh(text, "a.bvh");
  if (!motion.ok()) FAIL(motion.error().message);
  CHECK(motion->joints[1].name == "LEFT LEG");
}

TEST_CASE("BVH of others: a byte order mark, no blank before the numbers") {
  const auto motion =
      parseBvh("\xEF\xBB\xBF" + kHierarchy + "MOTION\nFrames:1\nFrame Time:.1\n1 2 3 0 0 0 0 0 0\n", "a.bvh");
  if (!motion.ok()) FAIL(motion.error().message);
  CHECK(motion->frameCount == 1);
  expectBvhFault(kHierarchy + "MOTION\nFrames: 1\nFrame Time: 0,1\n", "decimal points, not commas");
  expectBvhFault("; a motion of another kind", "begins with HIERARCHY");
}

TEST_CASE("dialects of BVH: braces behind names, channels first, named ends, carriage returns") {
  std::string text =
      "HIERARCHY\nROOT Hips {\n CHANNELS 3 Zrotation Xrotation Yrotation\n OFFSET 0 1 0\n JOINT Left Leg{ OFFSET 0 -1 0\n"
      "  End Site Left Toe {\n OFFSET 0 -2 0\n }\n }\n}\nMOTION\nFrames: 2\nFrame Time: 1\n1 2 3\n4 5 6\n";
  for (const char end : {'\n', '\r'}) {
    std::ranges::replace(text, '\n', end);
    const auto motion = parseBvh(text, "a.bvh");
    if (!motion.ok()) FAIL(motion.error().message);
    REQUIRE(motion->joints.size() == 2);
    CHECK(motion->joints[0].name == "Hips");
    CHECK(motion->joints[1].name == "Left Leg");
    CHECK(motion->joints[1].endOffset == vec3(0, -2, 0));
    CHECK(motion->frameCount == 2);
  }
  expectBvhFault(std::string("\xFF\xFEH\0I\0", 6), "a.bvh: the text is UTF-16; save it as UTF-8");
  expectBvhFault(std::string("H\0I\0E\0", 6), "UTF-16");
  expectBvhFault(kHierarchy + "MOTION\nFrames: 1\nFrame Time: 33.3333\n1 2 3 0 0 0 0 0 0\n",
                 "in seconds, not milliseconds: write 0.0333333");
}

TEST_CASE("places of joints that are zero in every frame were not recorded: the OFFSETs hold") {
  std::string hierarchy = kHierarchy;
  const std::string three = "CHANNELS 3 ";
  hierarchy.replace(hierarchy.find(three), three.size(), "CHANNELS 6 Xposition Yposition Zposition ");
  const std::string head = hierarchy + "MOTION\nFrames: 2\nFrame Time: .1\n";
  const auto motion = parseBvh(head + "0 0 0 0 0 0  0 0 0 0 0 0\n0 0 0 0 0 0  0 0 0 90 0 0\n", "a.bvh");
  if (!motion.ok()) FAIL(motion.error().message);
  CHECK(motion->translation(0, 0) == vec3(0));  // a root is where its channels have it
  CHECK(motion->joints[0].moves);
  for (const std::uint32_t frame : {0u, 1u}) CHECK(motion->translation(frame, 1) == vec3(0, -1, 0));
  CHECK_FALSE(motion->joints[1].moves);
  const auto moving = parseBvh(head + "0 0 0 0 0 0  0 0 0 0 0 0\n0 0 0 0 0 0  0 0 .1 0 0 0\n", "a.bvh");
  if (!moving.ok()) FAIL(moving.error().message);
  CHECK(moving->translation(0, 1) == vec3(0));
  CHECK(moving->joints[1].moves);
}

TEST_CASE("BVH frames are rows: what does not fit the hierarchy is named with its row") {
  const std::string motion = kHierarchy + "MOTION\nFrames: 3\nFrame Time: 0.1\n";
  const std::string row = "1 2 3 4 5 6 7 8 9\n", narrow = "1 2 3 4 5 6 7 8\n",
                    broad = "1 2 3 4 5 6 7 8 9 10\n";
  expectBvhFault(
      motion + broad + broad + broad,
      "a.bvh:19: this row holds 10 values, and the hierarchy has 9 channels; export the motion again");
  expectBvhFault(motion + narrow + narrow + narrow + narrow, "a.bvh:19: this row holds 8 values");
  expectBvhFault(motion + row + narrow + row + row, "a.bvh:20: this row holds 8 values");
  expectBvhFault(motion + row + row + narrow, "a.bvh:21: this row holds 8 values");
  expectBvhFault(motion + row + row + "      \n", "the file ends after 2 of its 3 frames");
  // Over several rows.
  const std::string wrapped = "1 2 3 4\n5 6 7 8\n\n9\n";
  const auto read = parseBvh(motion + wrapped + wrapped + wrapped.substr(0, wrapped.size() - 1), "a.bvh");
  if (!read.ok()) FAIL(read.error().message);
  CHECK(read->translation(2, 0) == vec3(1, 2, 3));
  expectBvhFault(motion + wrapped + "1 2 3 4\n5 6 7\n9\n" + wrapped,
                 "a.bvh:23: the 4 rows from here hold 12 values");
  // What stands behind the last frame is told, and no reason to refuse the others.
  for (const std::string& rest : {row, kHierarchy, std::string(" \r\n\0\x1a", 5)}) {
    const auto more = parseBvh(motion + row + row + row + rest, "a.bvh");
    if (!more.ok()) FAIL(more.error().message);
    CHECK(more->frameCount == 3);
  }
}

TEST_CASE("what is wrong with a BVH file is told with its line") {
  const std::string motion = "MOTION\nFrames: 1\nFrame Time: 0.1\n";
  expectBvhFault("", "a.bvh:1: a motion in .bvh begins with HIERARCHY, found the file's end");
  expectBvhFault("HIERARCHY\nJOINT a\n", "a.bvh:2: expected ROOT, found 'JOINT'");
  expectBvhFault("HIERARCHY\nROOT a\n{\n OFFSET 0 nan 0\n",
                 "a.bvh:4: an offset must be a finite number, found 'nan'");
  expectBvhFault("HIERARCHY\nROOT\n{\n", "needs a name");
  expectBvhFault("HIERARCHY\nROOT a\n{\n OFFSET 0 0 0\n CHANNELS 1 Xscale\n",
                 "a.bvh:5: a channel must be a position or rotation such as Xrotation, found 'Xscale'");
  expectBvhFault("HIERARCHY\nROOT a\n{\n OFFSET 0 0 0\n CHANNELS 9 Xrotation\n", "from 0 to 6");
  expectBvhFault("HIERARCHY\nROOT a\n{\n OFFSET 0 0 0\n BONE b\n",
                 "expected JOINT, End Site or }, found 'BONE'");
  expectBvhFault(kHierarchy, "expected MOTION, found the file's end; export the skeleton of one person with");
  expectBvhFault(kHierarchy + kHierarchy, "expected MOTION, found 'HIERARCHY'; export the skeleton of one");
  expectBvhFault(kHierarchy + "MOTION\nFrames: 0\n", "there are no frames");
  expectBvhFault(kHierarchy + "MOTION\nFrames: 1\nFrame Time: 0\n", "must be above zero");
  expectBvhFault(kHierarchy + "MOTION\nFrames: 9999999\nFrame Time: 0.1\n", "fewer values");
  const std::string row = kHierarchy + motion;
  expectBvhFault(row + "1.5,2.5,3,4,5,6,7,8,9          \n",
                 "found '1.5,2.5,3,4,5,6,7,8,9'; divide numbers by");
  expectBvhFault(row + "1.5, 2.5, 3, 4, 5, 6, 7, 8, 9\n", "found '1.5,'; divide numbers by blanks");
  expectBvhFault(row + "1;2;3;4;5;6;7;8;9              \n", "divide numbers by blanks");
  expectBvhFault(row + "1,5 2 3 4 5 6 7 8 9            \n", "found '1,5'; write decimal points");
  expectBvhFault(kHierarchy + motion + "1 2 3 4 5 6 7 8 x         \n", "found 'x'");
  expectBvhFault(kHierarchy + motion + "1 2 3 4 5 6 7 8           \n", "this row holds 8 values");
  std::string deep = "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\n";
  for (int i = 0; i < 400; ++i) deep += "JOINT b\n{\nOFFSET 0 0 0\n";
  expectBvhFault(deep, "nested deeper than 256");
  CHECK(readBvh("/nowhere/a.bvh").error().fault == Fault::io);
}

TEST_CASE("joint maps: pairs, comments, joints left out; a bad line is named") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "map.txt";
  REQUIRE(writeFileAtomically(path, std::string("# pairs\nLeft Leg = thigh.L # here\n\n Extra =\n")).ok());
  const auto map = readJointMap(path);
  REQUIRE(map.ok());
  CHECK(*map == JointMap{{"Left Leg", "thigh.L"}, {"Extra", ""}});
  REQUIRE(writeFileAtomically(path, std::string("a = b\nc\n")).ok());
  const auto bad = readJointMap(path);
  REQUIRE(!bad.ok());
  CHECK(bad.error().message.find("map.txt:2: a line must be") != std::string::npos);
}

TEST_CASE("joint maps: names that hold signs, comments, and what says a joint twice") {
  const auto map =
      parseJointMap("# a comment\nhip#1 = pelvis\t# the root\na=b = c = d\nleft=LeftArm\nend =\n", "m.txt");
  REQUIRE(map.ok());
  CHECK(*map == JointMap{{"hip#1", "pelvis"}, {"a=b", "c = d"}, {"left", "LeftArm"}, {"end", ""}});
  const auto refusal = [](const char* text) {
    const auto read = parseJointMap(text, "m.txt");
    return read.ok() ? std::string() : read.error().message;
  };
  CHECK(refusal("a = b\na = c\n").starts_with("m.txt:2: 'a' is on the left twice"));
  CHECK(refusal("a = b\n\nc = b\n").starts_with("m.txt:3: 'b' is moved by 'a' already"));
  CHECK(refusal("a =\nb =\n").empty());
  CHECK(refusal("= b\n").starts_with("m.txt:1: a line must be"));
  CHECK(refusal("\"\" = b\n").starts_with("m.txt:1: a line must be"));
}

TEST_CASE("joint maps: any name is read back as it is written") {
  const std::vector<std::string> names{"Hips",   "#Hips",      "Head #1", " Neck ",  "a = b", "=c", "\"q\"",
                                       "back\\", "two\nlines", "\"",      "x # \"y", "hip#2", "a ="};
  std::string text;
  JointMap told;
  for (const std::string& name : names) {
    told[name] = name + " of #the body";
    text += jointMapName(name) + " = " + jointMapName(told[name]) + "  # a part\n";
  }
  const auto map = parseJointMap(text, "m.txt");
  REQUIRE_MESSAGE(map.ok(), map.error().message);
  CHECK(*map == told);
  CHECK(jointMapName("Left Leg") == "Left Leg");
  const auto mixed =
      parseJointMap("\"a\" b = c\n\"d\" =\n# \"e\" = f\n\"g # h\" = i # j\nk=l # was = \"m\"\n", "m.txt");
  REQUIRE(mixed.ok());
  CHECK(*mixed == JointMap{{"\"a\" b", "c"}, {"d", ""}, {"g # h", "i"}, {"k", "l"}});
}
