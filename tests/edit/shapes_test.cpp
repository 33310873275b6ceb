#include <doctest/doctest.h>

#include <algorithm>

#include "curve/arc_length.h"
#include "edit/edited.h"

using namespace vasa;
using namespace vasa::test;

TEST_CASE("a stenosis narrows the diameter by its per cent where it is, and nothing elsewhere") {
  const Network before = smallTree();
  for (const int percent : {30, 70, 95, 99}) {
    const Network after = edited(before, "stenosis trunk 0.7 12 " + std::to_string(percent));
    const float was = at(before, "trunk", 0.7f).w;
    CHECK(leastRadius(after, "trunk") ==
          doctest::Approx(was * (1 - 0.01 * percent)).epsilon(percent > 90 ? 0.05 : 0.005));
    CHECK(at(after, "trunk", 0.5f).w == doctest::Approx(at(before, "trunk", 0.5f).w).epsilon(0.002));
    CHECK(at(after, "trunk", 0.74f).w == doctest::Approx(at(before, "trunk", 0.74f).w).epsilon(0.01));
    CHECK(glm::distance(vec3(at(after, "trunk", 0.7f)), vec3(at(before, "trunk", 0.7f))) < 2e-5f);
  }
}

TEST_CASE("an eccentric stenosis leaves one wall where it is") {
  const Network before = smallTree(), after = edited(before, "stenosis trunk 0.7 36 60 1");
  const vec4 was = at(before, "trunk", 0.7f), is = at(after, "trunk", 0.7f);
  CHECK(is.w == doctest::Approx(0.4f * was.w).epsilon(0.02));
  CHECK(glm::distance(vec3(was), vec3(is)) == doctest::Approx(0.6f * was.w).epsilon(0.03));
}

TEST_CASE("an aneurysm is as wide as it was asked for, to a side if that is told") {
  const Network before = smallTree();
  const Network round = edited(before, "aneurysm trunk 0.7 50 30");
  CHECK(greatestRadius(round, "trunk") == doctest::Approx(0.015f).epsilon(0.004));
  const Network left = edited(before, "aneurysm trunk 0.7 80 16 left");
  CHECK(greatestRadius(left, "trunk") == doctest::Approx(0.008f).epsilon(0.004));
  const vec3 moved = vec3(at(left, "trunk", 0.7f)) - vec3(at(before, "trunk", 0.7f));
  CHECK(moved.x == doctest::Approx(0.008f - at(before, "trunk", 0.7f).w).epsilon(0.05));
  CHECK(std::abs(moved.y) < 1e-4f);
}

TEST_CASE("a radius is multiplied along a stretch, or in its middle only") {
  const Network before = smallTree();
  const Network whole = edited(before, "radius far 0.3 0.6 x0.5");
  CHECK(at(whole, "far", 0.31f).w == doctest::Approx(0.0015f).epsilon(0.01));
  CHECK(at(whole, "far", 0.45f).w == doctest::Approx(0.0015f).epsilon(0.01));
  CHECK(at(whole, "far", 0.26f).w == doctest::Approx(0.003f).epsilon(0.01));
  CHECK(at(whole, "far", 0.64f).w == doctest::Approx(0.003f).epsilon(0.01));
  const Network middle = edited(before, "radius far 0.3 0.6 x2 smooth");
  CHECK(at(middle, "far", 0.45f).w == doctest::Approx(0.006f).epsilon(0.01));
  CHECK(at(middle, "far", 0.301f).w == doctest::Approx(0.003f).epsilon(0.01));
  const Network all = edited(before, "radius far 0 1 x2");
  CHECK(leastRadius(all, "far") == doctest::Approx(0.006f).epsilon(0.004));
  CHECK(greatestRadius(all, "far") == doctest::Approx(0.006f).epsilon(0.004));
}

TEST_CASE("a stent holds the lumen open and leaves wider parts alone") {
  const Network before = smallTree();
  const Network narrow = edited(before, "stenosis far 0.5 20 80");
  const Network after = edited(before, "stenosis far 0.5 20 80\nstent far 0.42 0.58 2.5");
  CHECK(leastRadius(narrow, "far") < 0.0007f);
  CHECK(leastRadius(after, "far") >= 0.0025f * 0.997f);
  CHECK(at(after, "far", 0.5f).w == doctest::Approx(0.0025f).epsilon(0.02));
  CHECK(at(after, "far", 0.1f).w == doctest::Approx(0.003f).epsilon(1e-4));
}

TEST_CASE("an occlusion leaves a hundredth of the lumen's width") {
  const Network after = edited(smallTree(), "occlude far 0.5");
  CHECK(leastRadius(after, "far") < 0.0001f);
  CHECK(leastRadius(after, "far") > 0);
}

TEST_CASE("what hangs on a moved vessel moves along, with what hangs on that; other ends stay") {
  const Network before = smallTree();
  const Network after = edited(before, "move trunk 0.4 0 -10 0 60");
  CHECK(at(after, "trunk", 0.4f).y == doctest::Approx(0.99f).epsilon(0.001));
  const Host host = *after.node(vesselNamed(after, "side").start).host;
  CHECK(vec3(evaluate(pointsOf(after, "trunk"), host.parameter)) == vec3(pointsOf(after, "side").front()));
  CHECK(pointsOf(after, "side").front().y == doctest::Approx(0.99f).epsilon(0.001));
  CHECK(pointsOf(after, "side").back() == pointsOf(before, "side").back());
  const Network twig = edited(before, "move side 0.6 0 0 4 20");
  const Host on = *twig.node(vesselNamed(twig, "twig").start).host;
  CHECK(vec3(evaluate(pointsOf(twig, "side"), on.parameter)) == vec3(pointsOf(twig, "twig").front()));
  CHECK(pointsOf(twig, "twig").front().z > 0.083f);
  CHECK(pointsOf(twig, "side").front() == pointsOf(before, "side").front());
}

TEST_CASE("a branch stays where its host is drawn anew without being moved") {
  const Network before = smallTree(), after = edited(before, "stenosis trunk 0.4 10 50");
  CHECK(glm::distance(pointsOf(before, "side").front(), pointsOf(after, "side").front()) < 2e-5f);
  CHECK(std::ranges::equal(pointsOf(before, "twig"), pointsOf(after, "twig")));
  CHECK(std::ranges::equal(pointsOf(before, "far"), pointsOf(after, "far")));
}

TEST_CASE("shapes that can not be are refused with line, vessel, place and rule") {
  const Network tree = smallTree();
  CHECK(refusalOf(tree, "\nstenosis trnk 0.1 12 70") ==
        "t.vedit:2: stenosis of \"trnk\" at 0.1: no vessel has this name; did you mean trunk?");
  CHECK(refusalOf(tree, "occlude spleen 0.1")
            .find("no vessel has this name; vasa info NET.vasa --vessels lists all") != std::string::npos);
  CHECK(refusalOf(tree, "stenosis side 0.5 90 70")
            .find("length_mm 90.0 is more than the vessel's own 60.0 mm") != std::string::npos);
  CHECK(refusalOf(tree, "aneurysm side 0.5 90 70")
            .find("length_mm 90.0 is more than the vessel's own 60.0 mm") != std::string::npos);
  CHECK(
      refusalOf(tree, "aneurysm side 0.5 10 3") ==
      "t.vedit:1: aneurysm of \"side\" at 0.5: diameter_mm 3.0 is no more than the 4.0 mm that the vessel has there");
  CHECK(refusalOf(tree, "aneurysm side 0.5 10 8 left").find("runs to that side itself") != std::string::npos);
  CHECK(refusalOf(tree, "aneurysm trunk 0.7 40 40 left").find("the wall would fold over itself at") !=
        std::string::npos);
  CHECK(refusalOf(tree, "stent side 0.1 0.9 1").find("nowhere narrower there than radius_mm 1.00") !=
        std::string::npos);
  CHECK(refusalOf(tree, "move side 0 0 5 0").find("too near to be moved by 5.0 mm") != std::string::npos);
  CHECK(refusalOf(tree, "move side 0.5 0 5 0 3").find("too near to be moved by 5.0 mm") != std::string::npos);
}
