#include <doctest/doctest.h>

#include "collide/network_tubes.h"
#include "fuzz/growth.h"
#include "io/markups.h"
#include "io/swc.h"
#include "network/centrelines.h"

using namespace vasa;
using namespace vasa::test;

TEST_CASE("SWC of nasty shapes grows in proportion") {
  const auto sample = [](std::size_t id, std::size_t parent) {
    return of(id) + " 0 " + of(id) + " 0 0 1 " + (id == parent ? "-1" : of(parent)) + "\n";
  };
  checkGrowth(
      {{"a chain", 10'000,
        [&](std::size_t n) { return times(n, [&](std::size_t i) { return sample(i + 1, i ? i : 1); }); }},
       {"a star", 10'000,
        [&](std::size_t n) { return times(n, [&](std::size_t i) { return sample(i + 1, 1); }); }},
       {"ids that meet in one place of a hash table", 20'000,
        [&](std::size_t n) {
          // Libstdc++'s.
          const std::size_t buckets = n > 62'233 ? 126'271 : n > 30'727 ? 62'233 : 30'727;
          return times(n, [&](std::size_t i) {
            return of((i + 1) * buckets) + " 0 " + of(i) + " 0 0 1 " + (i ? of(i * buckets) : "-1") + "\n";
          });
        }},
       {"samples without radii", 10'000,
        [](std::size_t n) {
          return times(n, [n](std::size_t i) {
            return of(i + 1) + " 0 " + of(i) + " 0 0 " + (i + 1 == n ? "1 " : "0 ") + (i ? of(i) : "-1") +
                   "\n";
          });
        }},
       {"roots", 10'000,
        [](std::size_t n) { return times(n, [](std::size_t i) { return of(i) + " 0 0 0 0 1 -1\n"; }); }}},
      [](const std::string& file) {
        const auto samples = parseSwc(file, "f");
        if (samples) (void)centrelinesOfSwc(*samples, "f", VesselKind::artery);
        return messageOf(samples);
      });
}

TEST_CASE("curves of 3D Slicer grow in proportion") {
  const auto curve = [](const std::string& points, const std::string& radii) {
    return R"({"markups":[{"type":"Curve","controlPoints":[)" + points +
           R"(],"measurements":[{"name":"Radius","controlPointValues":[)" + radii + "]}]}]}";
  };
  const auto list = [](std::size_t n, const auto& item) {
    return times(n, [&](std::size_t i) { return (i > 0 ? "," : "") + item(i); });
  };
  checkGrowth(
      {{"control points", 3000,
        [&](std::size_t n) {
          return curve(list(n, [](std::size_t i) { return R"({"position":[0,0,)" + of(i) + "]}"; }),
                       list(n, [&](std::size_t i) { return std::string(i + 1 == n ? "1" : "0"); }));
        }},
       {"empty points", 20'000,
        [&](std::size_t n) { return curve(list(n, [](std::size_t) { return std::string("{}"); }), "1"); }},
       {"curves", 2000,
        [&](std::size_t n) {
          const std::string one =
              R"({"type":"Curve","controlPoints":[{"position":[0,0,1]},{"position":[0,0,2]}],)"
              R"("measurements":[{"name":"r","controlPointValues":[1,1]}]})";
          return R"({"markups":[)" + list(n, [&](std::size_t) { return one; }) + "]}";
        }}},
      [](const std::string& file) { return messageOf(parseMarkups(file, "f", VesselKind::artery)); });
}

TEST_CASE("combs of branches and who is whose neighbour in them grow in proportion") {
  // Along x, one tooth every step [mm]; the host is 5 mm thick.
  const auto comb = [](std::size_t teeth, double step) {
    std::string text = "1 2 -20 0 0 5 -1\n";
    const auto id = [](std::size_t tooth) { return of(4 * tooth + 2); };
    for (std::size_t i = 0; i < teeth; ++i) {
      const std::string x = std::to_string(step * double(i));
      text += id(i) + " 2 " + x + " 0 0 5 " + (i ? id(i - 1) : "1") + "\n";
      for (std::size_t k = 1; k < 4; ++k)
        text += of(4 * i + 2 + k) + " 2 " + x + " " + of(20 * k) + " 0 1 " + of(4 * i + 1 + k) + "\n";
    }
    return text + of(4 * teeth + 2) + " 2 " + std::to_string(step * double(teeth) + 20) + " 0 0 5 " +
           id(teeth - 1) + "\n";
  };
  checkGrowth({{"teeth", 200, [&](std::size_t n) { return comb(n, 0.1); }},
               {"teeth at almost one place", 300, [&](std::size_t n) { return comb(n, 1e-3); }}},
              [](const std::string& file) -> std::string {
                const auto samples = parseSwc(file, "f");
                REQUIRE(samples.ok());
                const auto made = networkOfCentrelines(centrelinesOfSwc(*samples, "f", VesselKind::artery));
                if (made) CHECK(NetworkTubes(made->network).neighbours().pairCount() > 200);
                return messageOf(made);
              });
}
