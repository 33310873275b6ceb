#include "edit/replay.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <random>

#include "edit/edited.h"
#include "network/builder.h"
#include "network/file.h"
#include "support/networks.h"

using namespace vasa;
using namespace vasa::test;

TEST_CASE("a replay tells of every line, where vessels came from and which were drawn anew") {
  const Replay replay = replayed(
      smallTree(), "occlude far 0.5\nocclude spleen 0.5\nbranch trunk 0.8 bud 1 20 1 0 0\ndelete twig");
  REQUIRE(replay.rows.size() == 4);
  CHECK(replay.applied() == 3);
  CHECK(replay.rows[0].where == "t.vedit:1");
  CHECK(replay.rows[0].operation == "occlude");
  CHECK(replay.rows[0].change.find("diameter 0.0") == 0);
  CHECK(replay.rows[1].refusal.starts_with("t.vedit:2: occlude of \"spleen\" at 0.5: "));
  CHECK(replay.origins == std::vector<VesselId>{{0}, {1}, {3}, {}});
  CHECK(replay.redrawn == std::vector<char>{0, 0, 1, 1});
  const auto edits = parseJournal("occlude spleen 0.5\nocclude far 0.5\ndelete nobody", "t.vedit");
  const auto network = editNetwork(smallTree(), *edits);
  REQUIRE(!network.ok());
  CHECK(network.error().fault == Fault::badInput);
  CHECK(std::ranges::count(network.error().message, '\n') == 1);
}

// Vessels of a winding network have no names; the journal needs some.
static Network named(Network network) {
  NetworkBuilder builder;
  for (std::uint32_t v = 0; v < network.vessels().size(); ++v) {
    const auto points = network.pointsOf(network.vessels()[v]);
    builder.addVessel({fmt::format("v{}", v), "", VesselKind::artery}, {points.begin(), points.end()});
  }
  for (const Node& node : network.nodes())
    builder.addNode(node.host, {network.ends(node).begin(), network.ends(node).end()});
  auto built = builder.build(network.bodyHeight());
  REQUIRE(built.ok());
  return std::move(*built);
}

static std::vector<std::string> randomLines(std::size_t count, std::uint32_t vessels) {
  std::mt19937 random(7);
  const auto number = [&](double low, double high) {
    return low + (high - low) * double(random() % 1000) / 999;
  };
  std::vector<std::string> lines;
  while (lines.size() < count) {
    const std::string v = fmt::format("v{}", random() % vessels), w = fmt::format("v{}", random() % vessels);
    const double s = number(0, 1), t = number(0, 1);
    switch (random() % 12) {
      case 0:
        lines.push_back(fmt::format("radius {} {} {} x{} {}", v, 0.5 * s, 0.5 * s + 0.5, number(0.5, 2),
                                    random() % 2 ? "smooth" : ""));
        break;
      case 1:
        lines.push_back(fmt::format("stenosis {} {} {} {}", v, s, number(3, 30), number(5, 95)));
        break;
      case 2:
        lines.push_back(fmt::format("aneurysm {} {} {} {}", v, s, number(5, 60), number(5, 50)));
        break;
      case 3:
        lines.push_back(fmt::format("move {} {} {} {} {}", v, s, number(-9, 9), number(-9, 9), number(1, 9)));
        break;
      case 4:
        lines.push_back(fmt::format("stent {} {} {} {}", v, 0.5 * s, 0.5 * s + 0.4, number(1, 9)));
        break;
      case 5:
        lines.push_back(
            fmt::format("branch {} {} new{} 2 40 {} {} 1", v, s, lines.size(), number(-9, 9), number(-9, 9)));
        break;
      case 6:
        lines.push_back(fmt::format("occlude {} {}", v, s));
        break;
      case 7:
        lines.push_back(fmt::format("cut {} {} {}", v, 0.5 * s, 0.5 * s + 0.4));
        break;
      case 8:
        lines.push_back(fmt::format("rename {} {}x", v, v));
        break;
      case 9:
        lines.push_back(fmt::format("kind {} vein", v));
        break;
      case 10:
        lines.push_back(fmt::format("delete {} tree", v));
        break;
      default:
        if (v != w) lines.push_back(fmt::format("join {} {}", v, w));
    }
    (void)t;
  }
  return lines;
}

TEST_CASE(
    "200 random edits: every network is whole, the first n lines make what undoing the others makes, none makes the first network") {
  const Network begun = named(windingNetwork(60, 3));
  const auto bytes = encodeNetwork(begun);
  const auto lines = randomLines(200, 60);
  const auto journalOf = [&](std::size_t count) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i) text += lines[i] + "\n";
    return text;
  };
  // Replayed in one go, and step by step down again.
  const Replay all = replayed(begun, journalOf(200));
  MESSAGE(all.applied() << " of 200 applied");
  CHECK(all.applied() > 80);
  for (const vec4& p : all.network.points()) CHECK(p.w > 0);
  const auto decoded = decodeNetwork(encodeNetwork(all.network), "t");
  REQUIRE(decoded.ok());
  std::vector<std::vector<std::byte>> up;
  for (const std::size_t count : {0, 50, 100, 150})
    up.push_back(encodeNetwork(replayed(begun, journalOf(count)).network));
  for (std::size_t k = 4; k-- > 0;) CHECK(encodeNetwork(replayed(begun, journalOf(50 * k)).network) == up[k]);
  CHECK(up[0] == bytes);
  CHECK(encodeNetwork(begun) == bytes);
}
