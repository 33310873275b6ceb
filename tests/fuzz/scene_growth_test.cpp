// Our own files, and motions: what a scene names besides bodies.
#include <doctest/doctest.h>

#include "core/hash.h"
#include "fuzz/growth.h"
#include "growth/growth_rules.h"
#include "growth/regions.h"
#include "io/bvh.h"
#include "network/file.h"
#include "scene/scene_file.h"

using namespace vasa;
using namespace vasa::test;

namespace {

// The chunks of a network with header and checksum.
std::string vasaOf(const std::string& body) {
  std::string file = "VASA";
  const std::uint32_t version = 1;
  const std::uint64_t length = body.size(), hash = hashBytes(bytesOf(body));
  file.append(reinterpret_cast<const char*>(&version), 4).append(reinterpret_cast<const char*>(&length), 8);
  return file.append(reinterpret_cast<const char*>(&hash), 8) + body;
}
std::string chunk(const char* tag, const std::string& payload) {
  const auto size = std::uint32_t(payload.size());
  return std::string(tag, 4).append(reinterpret_cast<const char*>(&size), 4) + payload;
}
std::string leb(std::size_t value) {
  std::string out;
  for (; value >= 0x80; value >>= 7) out += char(value | 0x80);
  return out + char(value);
}

}  // namespace

TEST_CASE("BVH and joint maps of nasty shapes grow in proportion") {
  const auto motion = [](std::size_t joints, std::size_t frames) {
    return "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\n" +
           times(joints, "JOINT b\n{\nOFFSET 0 0 0\n}\n") + "}\nMOTION\nFrames: " + of(frames) +
           "\nFrame Time: 0.01\n" + times(frames, "0\n");
  };
  const auto rows = [](std::size_t n, const std::string& end) {
    return "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 2 Xrotation Yrotation\n}\nMOTION\nFrames: " + of(n) +
           "\nFrame Time: 0.01\n" + times(n, "0\n0\n") + end;
  };
  checkGrowth(
      {{"frames", 10'000, [&](std::size_t n) { return motion(1, n); }},
       {"frames of two rows", 10'000, [&](std::size_t n) { return rows(n, {}); }},
       {"rows behind the last frame", 20'000, [&](std::size_t n) { return rows(3, times(n, "0 0\n")); }},
       {"a long row", 50'000, [&](std::size_t n) { return rows(3, times(n, "0 ")); }},
       {"frames of joints without channels", 5'000, [&](std::size_t n) { return motion(4000, n); }}},
      [](const std::string& file) { return messageOf(parseBvh(file, "f")); });
  checkGrowth({{"pairs", 10'000,
                [](std::size_t n) { return times(n, [](std::size_t i) { return of(i) + "=\n"; }); }}},
              [](const std::string& file) { return messageOf(parseJointMap(file, "f")); });
}

TEST_CASE("scenes and rules of nasty shapes grow in proportion") {
  checkGrowth(
      {{"networks", 10'000, [](std::size_t n) { return R"({"networks":)" + list(times(n, "\"\",")) + "}"; }},
       {"numbers", 50'000,
        [](std::size_t n) { return R"({"camera":{"position":)" + list(times(n, "0,")) + "}}"; }}},
      [](const std::string& file) { return messageOf(parseScene(file, "folder", "f")); });
  checkGrowth({{"letters", 30'000,
                [](std::size_t n) {
                  return "system a\naxiom S\n" +
                         times(n, [](std::size_t i) { return "draw a" + of(i) + "\n"; });
                }},
               {"brackets", 20'000,
                [](std::size_t n) { return "system a\naxiom S\ndraw S\nS -> F " + times(n, "[S]") + "\n"; }}},
              [](const std::string& file) { return messageOf(parseGrowthRules(file, "f")); });
  const auto rules = parseGrowthRules("system a\naxiom S\ndraw S\n", "f");
  REQUIRE(rules.ok());
  checkGrowth({{"regions", 10'000,
                [](std::size_t n) {
                  return "region,system,joints,vessels,kinds,thinnest_mm,thickest_mm,bed_mm,surface\n" +
                         times(n, "a,-,,,,,,,\n");
                }}},
              [&](const std::string& file) { return messageOf(parseRegions(file, "f", *rules)); });
}

TEST_CASE("networks of nasty shapes grow in proportion") {
  const auto point = [](float x) {
    const float p[] = {x, 0, 0, 0.1f};
    return std::string(reinterpret_cast<const char*>(p), sizeof p);
  };
  const std::string meta = chunk("META", std::string("\0\0\x80\x3f", 4));
  const auto vessels = [&](std::size_t n, const std::string& points) {
    const std::string name(4096, 'a');
    return chunk("VESL",
                 leb(n) + std::string(1, '\0') + leb(0) + leb(4096) + name + leb(0) + leb(0) + points +
                     times(n - 1, std::string(1, '\0') + leb(4096) + leb(0) + leb(0) + leb(0) + points));
  };
  checkGrowth(
      {{"names that share 4096 letters", 2'000,
        [&](std::size_t n) {
          return vasaOf(meta + vessels(n, leb(4)) +
                        chunk("PNTS", times(4 * n, [&](std::size_t i) { return point(float(i)); })));
        }},
       {"vessels without points", 20'000,
        [&](std::size_t n) {
          return vasaOf(meta + chunk("VESL", leb(n) + times(n, std::string(6, '\0'))) + chunk("PNTS", ""));
        }},
       {"nodes without vessels", 20'000,
        [&](std::size_t n) {
          return vasaOf(meta + chunk("VESL", leb(0)) +
                        chunk("NODE", leb(n) + times(n, std::string("\0\1\0", 3))) + chunk("PNTS", ""));
        }}},
      [](const std::string& file) { return messageOf(decodeNetwork(bytesOf(file), "f")); });
}
