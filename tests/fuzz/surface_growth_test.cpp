#include <doctest/doctest.h>

#include <cmath>
#include <cstring>

#include "fuzz/growth.h"
#include "io/obj.h"
#include "io/stl.h"
#include "io/vtk.h"

using namespace vasa;
using namespace vasa::test;

TEST_CASE("OBJ of nasty shapes grows in proportion") {
  const auto star = [](std::size_t corners) {
    return times(corners, [&](std::size_t i) {
      const double angle = 2 * kPi * double(i) / double(corners), radius = i % 2 ? 0.5 : 1;
      return "v " + std::to_string(radius * std::cos(angle)) + " " +
             std::to_string(radius * std::sin(angle)) + " 0\n";
    });
  };
  const auto face = [](std::size_t corners) {
    return "f" + times(corners, [](std::size_t i) { return " " + of(i + 1); }) + "\n";
  };
  checkGrowth(
      {{"one polygon", 200, [&](std::size_t n) { return star(n) + face(n); }},
       {"polygons that turn inward", 20, [&](std::size_t n) { return star(512) + times(n, face(512)); }},
       {"polygons whose corners are one", 40,
        [&](std::size_t n) { return "v 0 0 0\n" + times(n, "f" + times(512, " 1") + "\n"); }},
       {"triangles", 20'000,
        [](std::size_t n) { return "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + times(n, "f 1 2 3\n"); }},
       {"objects", 10'000,
        [](std::size_t n) { return "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + times(n, "o a\nf 1 2 3\n"); }},
       {"groups in turn", 20'000,
        [](std::size_t n) {
          return "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + times(n, "g a\nf 1 2 3\ng b\nf 1 2 3\n");
        }},
       {"groups", 10'000,
        [](std::size_t n) {
          return "v 0 0 0\nv 1 0 0\nv 0 1 0\n" +
                 times(n, [](std::size_t i) { return "g a" + of(i) + "\nf 1 2 3\n"; });
        }},
       {"one line of many", 100'000,
        [](std::size_t n) { return "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl a" + times(n, "\\\n"); }},
       {"lines of two", 20'000,
        [](std::size_t n) { return "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + times(n, "f 1\\\r\n2 3\r\n"); }},
       {"objects without faces", 20'000,
        [](std::size_t n) { return "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n" + times(n, "g a\n"); }},
       {"vertices", 20'000, [](std::size_t n) { return times(n, "v 0 0 0\n") + "f 1 2 3\n"; }}},
      [](const std::string& file) { return messageOf(parseObj(file, "f")); });
}

TEST_CASE("STL of nasty shapes grows in proportion") {
  const auto facet = [](std::size_t i) {
    return "facet normal 0 0 0 outer loop vertex " + of(i) + " 0 0 vertex 1 0 0 vertex 0 1 " + of(i) +
           " endloop endfacet\n";
  };
  checkGrowth({{"facets", 3'000, [&](std::size_t n) { return "solid a\n" + times(n, facet) + "endsolid\n"; }},
               {"solids of one name that are numbered by others", 3'000,
                [&](std::size_t n) {
                  return times(n, [&](std::size_t i) {
                    return "solid f " + of(i) + "\n" + facet(i) + "endsolid\nsolid\n" + facet(i) +
                           "endsolid\n";
                  });
                }},
               {"solids", 3'000,
                [&](std::size_t n) {
                  return times(n, [&](std::size_t i) { return "solid a\n" + facet(i) + "endsolid\n"; });
                }},
               {"binary facets", 5'000,
                [](std::size_t n) {
                  std::string file(84 + 50 * n, '\0');
                  const auto count = std::uint32_t(n);
                  std::memcpy(file.data() + 80, &count, 4);
                  for (std::size_t i = 0; i < n; ++i)
                    for (int k = 0; k < 9; ++k) {
                      const float x = float((i * 9 + std::size_t(k)) % 1000);
                      std::memcpy(file.data() + 84 + 50 * i + 12 + 4 * std::size_t(k), &x, 4);
                    }
                  return file;
                }}},
              [](const std::string& file) { return messageOf(parseStl(bytesOf(file), "f")); });
}

TEST_CASE("legacy VTK of nasty shapes grows in proportion") {
  const std::string head =
      "# vtk DataFile Version 4.2\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 0 1 0 1 0 0\n";
  checkGrowth(
      {{"empty faces", 100'000,
        [&](std::size_t n) { return head + "POLYGONS " + of(n) + " " + of(n) + "\n" + times(n, "0\n"); }},
       {"triangles", 50'000,
        [&](std::size_t n) {
          return head + "POLYGONS " + of(n) + " " + of(4 * n) + "\n" + times(n, "3 0 1 2\n");
        }},
       {"arrays", 2'000,
        [&](std::size_t n) {
          return head + "POINT_DATA 3\nFIELD f " + of(n) + "\n" +
                 times(n, [](std::size_t i) { return 'a' + of(i) + " 1 3 int\n1 1 1\n"; });
        }}},
      [](const std::string& file) { return messageOf(parseVtkSurface(bytesOf(file), "f")); });
}
