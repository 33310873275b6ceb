#include <algorithm>
#include <cmath>

#include "collide/network_tubes.h"
#include "collide/tube_detector.h"
#include "human/made_human.h"
#include "network/file.h"

using namespace vasa;
using namespace vasa::human;

namespace {

const Vessel* vesselNamed(std::string_view name) {
  for (const Vessel& vessel : madeHuman().vessels.vessels())
    if (vessel.name == name) return &vessel;
  return nullptr;
}

/// A published artery. Reymond 2009: Reymond et al., Am J Physiol Heart 297:H208. ADAN56: Blanco et al. 2015,
/// IEEE Trans Biomed Eng 62:736, in the 56-vessel reduction.
struct Published {
  const char* name;
  float length, startRadius, endRadius;  ///< [m]
  bool bothSides = true;                 ///< a left one's right one is compared, too
};
constexpr Published kPublished[] = {
    {"ascending aorta", 0.040f, 0.0147f, 0.0144f},                    // Reymond 2009
    {"thoracic aorta", 0.156f, 0.0100f, 0.0065f},                     // Reymond 2009, segments A and B
    {"abdominal aorta", 0.127f, 0.0073f, 0.0059f},                    // ADAN56, segments I to V
    {"brachiocephalic trunk", 0.047f, 0.0067f, 0.0062f},              // ADAN56
    {"left common carotid artery", 0.139f, 0.0045f, 0.0033f, false},  // Reymond 2009, radii ADAN56
    {"right common carotid artery", 0.094f, 0.0045f, 0.0033f},        // Reymond 2009, radii ADAN56
    {"left internal carotid artery", 0.132f, 0.0028f, 0.0021f},       // ADAN56
    {"left vertebral artery", 0.204f, 0.0019f, 0.0014f},              // ADAN56 length, Reymond 2009 radii
    {"left subclavian artery", 0.090f, 0.0049f, 0.0030f, false},      // ADAN56, segments I and II
    {"right subclavian artery", 0.057f, 0.0049f, 0.0030f},            // ADAN56, segments I and II
    {"left axillary artery", 0.120f, 0.0030f, 0.0023f},               // ADAN56 length
    {"left brachial artery", 0.223f, 0.0021f, 0.0018f},               // ADAN56
    {"left radial artery", 0.301f, 0.0014f, 0.0014f},                 // ADAN56
    {"left common iliac artery", 0.074f, 0.0045f, 0.0041f},           // ADAN56
    {"left external iliac artery", 0.102f, 0.0034f, 0.0032f},         // ADAN56
    {"left internal iliac artery", 0.073f, 0.0028f, 0.0024f},         // ADAN56
    {"left femoral artery", 0.351f, 0.0032f, 0.0027f},                // ADAN56, segments I and II
    {"left deep femoral artery", 0.238f, 0.0021f, 0.0018f},           // ADAN56
    {"left popliteal artery", 0.141f, 0.0027f, 0.0023f},              // ADAN56
    {"left anterior tibial artery", 0.386f, 0.0013f, 0.0012f},        // ADAN56
    {"left posterior tibial artery", 0.383f, 0.0016f, 0.0014f},       // ADAN56 length, Reymond 2009 radii
};

/// Whether two vessels are the same or share a node, as ends or as its host.
bool meetAtNode(const Network& network, VesselId a, VesselId b) {
  if (a == b) return true;
  for (const Node& node : network.nodes()) {
    const auto there = [&](VesselId vessel) {
      const auto ends = network.ends(node);
      return (node.host && node.host->vessel == vessel) ||
             std::any_of(ends.begin(), ends.end(),
                         [&](const VesselEnd& end) { return end.vessel == vessel; });
    };
    if (there(a) && there(b)) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("all vessels have names, and all names differ") {
  std::vector<std::string> names;
  for (const Vessel& vessel : madeHuman().vessels.vessels()) {
    CHECK_FALSE(vessel.name.empty());
    names.push_back(vessel.name);
  }
  // Grown ones are numbered.
  CHECK(std::count_if(names.begin(), names.end(),
                      [](const std::string& name) { return name.back() < '0' || name.back() > '9'; }) >= 880);
  CHECK(madeHuman().vessels.sweepCount() >= 7110);
  CHECK(madeHuman().vessels.sweepCount() <= 7210);
  std::sort(names.begin(), names.end());
  CHECK(std::adjacent_find(names.begin(), names.end()) == names.end());
}

TEST_CASE("the systemic arteries are one network, the systemic veins another") {
  const Network& network = madeHuman().vessels;
  const std::vector<std::uint32_t> parts = network.components();
  const auto partOf = [&](std::string_view name) {
    const Vessel* vessel = vesselNamed(name);
    REQUIRE(vessel != nullptr);
    return parts[std::size_t(vessel - network.vessels().data())];
  };
  CHECK(network.componentCount() == 3);  // and the vessels of the lungs
  for (const char* name :
       {"right middle cerebral artery", "left ulnar palmar digital artery of little finger", "splenic artery",
        "right plantar digital artery of big toe"})
    CHECK(partOf(name) == partOf("ascending aorta"));
  for (const char* name : {"superior sagittal sinus", "right dorsal digital vein of index finger",
                           "left renal vein", "right dorsal venous arch of foot", "hemiazygos vein"})
    CHECK(partOf(name) == partOf("inferior vena cava"));
  CHECK(partOf("splenic vein") == partOf("inferior vena cava"));
  CHECK(partOf("pulmonary trunk") == partOf("left superior pulmonary vein"));
  CHECK(partOf("ascending aorta") != partOf("inferior vena cava"));
}

TEST_CASE(
    "main arteries have published lengths, at most two excepted, and radii within 15 %, on both sides") {
  int rows = 0, longer = 0;
  for (const Published& published : kPublished)
    for (const std::string_view side : {"left ", "right "}) {
      std::string name = published.name;
      if (!name.starts_with("left ")) {
        if (side == "right ") continue;
      } else if (published.bothSides) {
        name.replace(0, 5, side);
      } else if (side == "right ") {
        continue;
      }
      CAPTURE(name);
      const Vessel* vessel = vesselNamed(name);
      REQUIRE(vessel != nullptr);
      const auto points = madeHuman().vessels.pointsOf(*vessel);
      const auto isNear = [](float value, float wanted) { return std::abs(value / wanted - 1) <= 0.15f; };
      if (!isNear(lengthOf(points), published.length)) {
        MESSAGE(name << " is " << 1e3f * lengthOf(points) << " mm long, published "
                     << 1e3f * published.length);
        ++longer;
      }
      CAPTURE(points.front().w);
      CHECK(isNear(points.front().w, published.startRadius));
      CAPTURE(points.back().w);
      CHECK(isNear(points.back().w, published.endRadius));
      ++rows;
    }
  CHECK(rows == 34);
  CHECK(longer <= 2);
}

TEST_CASE("the vessels lie inside the skin") {
  const Network& network = madeHuman().vessels;
  int samples = 0, outside = 0;
  for (const Vessel& vessel : network.vessels())
    for (std::uint32_t k = 0; k <= vessel.spanCount() * 4; ++k) {
      const vec4 p = evaluate(network.pointsOf(vessel), float(k) / 4);
      ++samples;
      outside += madeHuman().skinShape.distance(vec3(p)) + p.w > 0.002f;
    }
  MESSAGE(outside << " of " << samples << " samples reach more than 2 mm outside");
  CHECK(outside <= samples / 1000);
}

TEST_CASE("a vessel's bends are wider than its radius") {
  const Network& network = madeHuman().vessels;
  for (const Vessel& vessel : network.vessels()) {
    CAPTURE(vessel.name);
    float worst = 0;
    for (std::uint32_t span = 0; span < vessel.spanCount(); ++span) {
      const Bezier bezier = bezierOfSpan(network.pointsOf(vessel), span);
      for (int k = 0; k <= 8; ++k) {
        const float t = float(k) / 8;
        const vec3 first(bezier.derivative(t)), second(bezier.secondDerivative(t));
        const float speed = glm::length(first);
        worst = std::max(worst,
                         bezier.at(t).w * glm::length(glm::cross(first, second)) / (speed * speed * speed));
      }
    }
    CHECK(worst < 1);
  }
}

TEST_CASE("at rest no vessel runs through another, but for those that meet at a fork") {
  const Network& network = madeHuman().vessels;
  const NetworkTubes layout(network);
  std::vector<Bezier> tubes(layout.count());
  layout.shape(network.points(), tubes);
  TubeDetector detector(tubes, layout.neighbours());
  detector.update(tubes);
  const std::span<const TubePair> pairs = detector.detect();
  int strangers = 0, relatives = 0;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const VesselId a = layout.address(pairs[k].i).vessel, b = layout.address(pairs[k].j).vessel;
    if (meetAtNode(network, a, b)) {
      ++relatives;
      continue;
    }
    ++strangers;
    MESSAGE(network.vessel(a).name << " and " << network.vessel(b).name << ": "
                                   << -1e3f * detector.contacts()[k].f << " mm");
  }
  MESSAGE(relatives << " pairs of spans touch beside a fork that their vessels share");
  CHECK(strangers == 0);
}

TEST_CASE("the network survives its file") {
  const std::vector<std::byte> bytes = encodeNetwork(madeHuman().vessels);
  const Result<Network> read = decodeNetwork(bytes, "human.vasa");
  REQUIRE(read.ok());
  CHECK(read->vessels().size() == madeHuman().vessels.vessels().size());
}
