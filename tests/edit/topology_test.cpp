#include <doctest/doctest.h>

#include <algorithm>

#include "edit/edited.h"

using namespace vasa;
using namespace vasa::test;

TEST_CASE("a branch is appended, leaves where it was asked to, and takes its host's kind") {
  const Network before = smallTree(),
                after = edited(before, "branch trunk 0.8 bud 1.5 25 0 -1 0.5\nbranch far 1 on 3 20 0 0 1");
  REQUIRE(after.vessels().size() == 6);
  CHECK(after.vessels()[4].name == "bud");
  CHECK(after.vessels()[4].kind == VesselKind::artery);
  CHECK(after.vessels()[5].kind == VesselKind::vein);
  CHECK(std::equal(before.points().begin(), before.points().end(), after.points().begin()));
  CHECK(lengthOf(pointsOf(after, "bud")) == doctest::Approx(0.025));
  CHECK(pointsOf(after, "bud").front().z == doctest::Approx(0.16));
  CHECK(after.node(vesselNamed(after, "bud").start).host->vessel == VesselId{0});
  const Node& on = after.node(vesselNamed(after, "on").start);
  CHECK(!on.host);
  CHECK(on.endCount == 2);
}

TEST_CASE("a cut leaves the rest as a vessel of its own, with what hangs on it") {
  const Network before = smallTree(), after = edited(before, "cut trunk 0.2 0.3");
  REQUIRE(after.vessels().size() == 5);
  CHECK(after.vessels()[4].name == "trunk (2)");
  CHECK(lengthOf(pointsOf(after, "trunk")) == doctest::Approx(0.04).epsilon(0.002));
  CHECK(lengthOf(pointsOf(after, "trunk (2)")) == doctest::Approx(0.14).epsilon(0.002));
  const Host host = *after.node(vesselNamed(after, "side").start).host;
  CHECK(host.vessel == VesselId{4});
  CHECK(glm::distance(pointsOf(after, "side").front(), pointsOf(before, "side").front()) < 2e-5f);
  const Network head = edited(before, "cut far 0.5 1"), tail = edited(before, "cut side 0 0.5");
  CHECK(lengthOf(pointsOf(head, "far")) == doctest::Approx(0.1).epsilon(0.002));
  CHECK(lengthOf(pointsOf(tail, "side")) == doctest::Approx(0.03).epsilon(0.002));
  CHECK(!vesselNamed(tail, "side").start.valid());
  CHECK(tail.nodes().size() == 1);
  CHECK(tail.node(vesselNamed(tail, "twig").start).host->vessel == VesselId{1});
}

TEST_CASE("what was cut apart can be joined") {
  const Network before = smallTree(), after = edited(before, "cut trunk 0.55 0.7\njoin trunk \"trunk (2)\"");
  CHECK(after.vessels().size() == 4);
  CHECK(lengthOf(pointsOf(after, "trunk")) == doctest::Approx(0.2).epsilon(0.005));
  CHECK(at(after, "trunk", 0.62f).w == doctest::Approx(at(before, "trunk", 0.62f).w).epsilon(0.03));
  CHECK(vesselNamed(after, "side").start.valid());
  CHECK(glm::distance(vec3(pointsOf(after, "side").front()), vec3(pointsOf(before, "side").front())) < 1e-4f);
  const Network reversed = edited(before, "branch far 0 on 3 30 0 0 -1\njoin on far");
  CHECK(reversed.vessels().size() == 4);
  CHECK(lengthOf(pointsOf(reversed, "on")) == doctest::Approx(0.23).epsilon(0.005));
}

TEST_CASE("names and kinds change, and vessels go with what hangs on them") {
  const Network before = smallTree();
  const Network after = edited(before, "rename far near\nkind near other\ndelete twig");
  CHECK(after.vessels().size() == 3);
  CHECK(vesselNamed(after, "near").kind == VesselKind::other);
  CHECK(after.nodes().size() == 1);
  const Network gone = edited(before, "delete side tree");
  CHECK(gone.vessels().size() == 2);
  CHECK(gone.nodes().empty());
}

TEST_CASE("what a deletion cuts off goes with it, beyond forks of equals, too") {
  // Two legs of one trunk, the left with two shins and a twig; the right is longer than all of them.
  const Network before =
      edited(smallTree(),
             "delete side tree\nbranch far 1 left 2 40 1 0 1\nbranch far 1 right 2 200 -1 0 1\n"
             "branch left 1 shin 1 30 1 0 0\nbranch left 1 calf 1 30 0 1 1\n"
             "branch shin 0.5 twig 0.5 10 0 0 1");
  REQUIRE(before.vessels().size() == 7);
  std::vector<std::string> left;
  const Network after = edited(before, "delete left tree");
  for (const Vessel& vessel : after.vessels()) left.push_back(vessel.name);
  CHECK(left == std::vector<std::string>{"trunk", "far", "right"});
  CHECK(edited(before, "delete shin tree").vessels().size() == 5);
  CHECK(edited(before, "delete left").vessels().size() == 6);
}

TEST_CASE("operations on vessels that can not be are refused with the rule") {
  const Network tree = smallTree();
  const auto refuses = [&](const char* line, const char* rule) {
    const std::string refusal = refusalOf(tree, line);
    CHECK_MESSAGE(refusal.find(rule) != std::string::npos, refusal);
  };
  refuses("branch trunk 0.5 side 1 20 1 0 0", "another vessel is named \"side\" already");
  refuses("branch trunk 0.5 bud 1 20 0.1 0 1", "dx dy dz runs along the vessel, 6 degrees off its course");
  refuses("branch trunk 0.5 bud 1 4 1 0 0",
          "length_mm 4.0 ends within the vessel, whose wall it meets after 4.5 mm");
  refuses("graft trunk 0.2 fra 0.5 2", "\"fra\": no vessel has this name; did you mean far?");
  refuses("graft trunk 0.2 TRUNK 0.5 2", "A and B must be two vessels");
  refuses("graft trunk 0.2 far 0.5 2 side", "another vessel is named \"side\" already");
  refuses("cut trunk 0.3 0.5", "\"side\" hangs on what would be cut out; delete it first");
  refuses("cut trunk 0 1", "nothing would be left of the vessel; write delete");
  refuses("cut far 0.01 0.5", "only 2.0 mm would be left on one side, less than the vessel is wide (6.0 mm)");
  refuses("join far side", "mm from \"side\", more than 50; write graft");
  refuses("rename far side", "another vessel is named \"side\" already");
  refuses(
      "delete trunk",
      "\"side\" hangs on it; delete it with its branches (in a journal: delete ... tree) to take all 2 below it away, too");
}

TEST_CASE("who joins vessels of two kinds is told which of them stays") {
  const Network kinds = edited(smallTree(), "cut trunk 0.55 0.7\nkind \"trunk (2)\" vein");
  const Replay joined = replayed(kinds, "join trunk \"trunk (2)\"");
  REQUIRE(joined.applied() == 1);
  CHECK(joined.rows[0].change.ends_with("; its kind was vein and is artery now"));
}

TEST_CASE("the last vessel can not be deleted, nor vessels joined that both meet others") {
  const Network one = edited(smallTree(), "delete trunk tree");
  CHECK(refusalOf(one, "delete far").find("no vessel would be left") != std::string::npos);
  const Network held = edited(
      smallTree(),
      "branch far 0 low 1 9 0 0 -1\nbranch far 0 low2 1 9 1 0 -1\nbranch far 1 high 1 9 0 0 1\nbranch far 1 high2 1 9 1 0 1");
  CHECK(refusalOf(held, "join far trunk").find("no end of it and none of \"trunk\" are both free") !=
        std::string::npos);
}
