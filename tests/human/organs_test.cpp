#include <algorithm>
#include <cctype>
#include <cmath>

#include "body/skinning.h"
#include "core/parallel.h"
#include "human/made_human.h"
#include "make_human/motion_probe.h"
#include "make_human/solid.h"

using namespace vasa;
using namespace vasa::human;

namespace {

constexpr std::size_t kFirst = 5;            // of the organs among the meshes
constexpr std::size_t kOrganVertexStep = 2;  // looked at for leaving the skin
constexpr float kOnWall = 4e-3f;             // [m] of the middle of a vessel that runs on a stomach or bowel

const SkinnedMesh& organ(std::string_view name) {
  const std::vector<SkinnedMesh>& meshes = madeHuman().meshes;
  const auto found = std::ranges::find(meshes, "organ: " + std::string(name), &SkinnedMesh::name);
  REQUIRE_MESSAGE(found != meshes.end(), name);
  return *found;
}

/// What an adult's has: from the smallest to the largest that textbooks call usual, both of a pair together;
/// lungs as full as at the end of a quiet breath; [ml].
struct Usual {
  const char* name;
  float least, most;
};
constexpr Usual kUsual[] = {
    {"heart", 450, 800},        {"right lung", 1000, 2200}, {"left lung", 900, 2000},
    {"liver", 900, 1800},       {"gall bladder", 10, 50},   {"stomach", 150, 1000},
    {"oesophagus", 15, 50},     {"windpipe", 20, 70},       {"pancreas", 45, 110},
    {"spleen", 70, 250},        {"kidney", 200, 360},       {"suprarenal gland", 5, 16},
    {"large bowel", 500, 1300}, {"small bowel", 500, 1300}, {"bladder", 40, 400}};

const char* const kCoronary[] = {"left coronary artery",
                                 "anterior interventricular artery",
                                 "circumflex artery",
                                 "right coronary artery",
                                 "posterior interventricular artery",
                                 "right posterolateral artery",
                                 "right marginal artery",
                                 "diagonal artery",
                                 "second diagonal artery",
                                 "left marginal artery",
                                 "posterior left ventricular artery",
                                 "great cardiac vein",
                                 "middle cardiac vein",
                                 "small cardiac vein",
                                 "posterior vein of left ventricle"};

/// Longest and shortest edges beside their lengths at rest.
vec2 stretch(const TriangleMesh& rest, const std::vector<vec3>& posed) {
  vec2 range(1, 1);
  for (const uvec3& t : rest.triangles)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      const float length = glm::distance(rest.positions[a], rest.positions[b]);
      if (length < 1e-3f) continue;
      const float share = glm::distance(posed[a], posed[b]) / length;
      range = {std::min(range.x, share), std::max(range.y, share)};
    }
  return range;
}

}  // namespace

TEST_CASE("every organ is there, as large as people's are") {
  for (const Usual& usual : kUsual) {
    CAPTURE(usual.name);
    const float millilitres = 1e6f * organ(usual.name).mesh.volume();
    CHECK(millilitres >= usual.least);
    CHECK(millilitres <= usual.most);
  }
}

TEST_CASE("organs together have the triangles that a picture's time allows") {
  std::size_t triangles = 0;
  for (std::size_t m = kFirst; m < madeHuman().meshes.size(); ++m)
    triangles += madeHuman().meshes[m].mesh.triangles.size();
  CHECK(triangles <= 44000);
}

TEST_CASE("at rest organs lie well below the skin and not in bones") {
  const Solid skin(madeHuman().meshes[0].mesh), bones(madeHuman().meshes[1].mesh);
  for (std::size_t m = kFirst; m < madeHuman().meshes.size(); ++m) {
    const SkinnedMesh& mesh = madeHuman().meshes[m];
    CAPTURE(mesh.name);
    float shallowest = 1, inBone = 0;
    for (const vec3 p : mesh.mesh.positions) {
      const auto place = skin.at(p, 0.02f);
      shallowest = std::min(shallowest, place ? -place->distance : -1.0f);
      if (const auto bone = bones.at(p, 0.001f)) inBone = std::max(inBone, -bone->distance);
    }
    CHECK(shallowest > 0.005f);
    CHECK(inBone < 0.005f);
  }
}

TEST_CASE("the vessels of the heart lie on its surface, in grooves of it") {
  const Solid heart(organ("heart").mesh);
  const Network& network = madeHuman().vessels;
  int samples = 0, near = 0, sunk = 0;
  for (const char* name : kCoronary) {
    CAPTURE(name);
    const auto vessel = std::ranges::find(network.vessels(), name, &Vessel::name);
    REQUIRE(vessel != network.vessels().end());
    const auto points = network.pointsOf(*vessel);
    for (float u = 0; u <= float(spanCount(points)); u += 0.25f) {
      const vec4 p = evaluate(points, u);
      const auto place = heart.at(vec3(p), 0.02f);
      ++samples;
      near += place && std::abs(place->distance) < p.w + 0.003f;
      sunk += place && place->distance < -p.w;
    }
  }
  CHECK(samples > 150);
  CHECK(float(near) >= 0.93f * float(samples));  // the right coronary artery begins on the aorta
  CHECK(float(sunk) <= 0.02f * float(samples));
}

TEST_CASE("small vessels grow within the organs they feed") {
  struct Grown {
    const char *organ, *vessels;
    int least;
  };
  const Network& network = madeHuman().vessels;
  for (const Grown& grown :
       {Grown{"left lung", "left pulmonary", 20}, Grown{"right lung", "right pulmonary", 20},
        Grown{"liver", "liver", 25}, Grown{"kidney", "kidney", 30}, Grown{"spleen", "spleen", 6},
        Grown{"stomach", "stomach", 6}, Grown{"small bowel", "small bowel", 12},
        Grown{"large bowel", "large bowel", 6}}) {
    CAPTURE(std::string(grown.organ));
    const Solid solid(organ(grown.organ).mesh);
    int vessels = 0, samples = 0, inside = 0;
    for (const Vessel& vessel : network.vessels()) {
      if (!std::isdigit(static_cast<unsigned char>(vessel.name.back()))) continue;
      if (vessel.name.find(grown.vessels) == std::string::npos) continue;
      ++vessels;
      const auto points = network.pointsOf(vessel);
      for (float u = 0; u <= float(spanCount(points)); u += 0.25f) {
        ++samples;
        const vec3 p(evaluate(points, u));
        inside += solid.winding(p) != 0 || solid.at(p, kOnWall);
      }
    }
    MESSAGE(grown.organ << ": " << vessels << " grown, " << inside << " of " << samples << " places inside");
    CHECK(vessels >= grown.least);
    CHECK(float(inside) >= 0.8f * float(samples));  // those of a stomach and bowel begin beside it
  }
}

TEST_CASE("organs follow the trunk in every motion, untorn and inside the skin") {
  std::vector<vec3> skin, posed;
  for (const Clip& clip : madeBody().clips) {
    CAPTURE(clip.name);
    float farthest = 0;
    vec2 range(1, 1);
    std::string which;
    for (std::size_t frame = 0; frame < clip.frameCount(); frame += kFrameStep) {
      const std::vector<mat4> matrices = skinMatrices(
          madeBody().skeleton, samplePose(madeBody().skeleton, clip, float(frame) / clip.framesPerSecond));
      skinPositions(madeBody().meshes[0], matrices, skin);
      const TriangleMesh surface{skin, madeBody().meshes[0].mesh.triangles};
      const Solid solid(surface);
      for (std::size_t m = kFirst; m < madeBody().meshes.size(); ++m) {
        skinPositions(madeBody().meshes[m], matrices, posed);
        const vec2 edges = stretch(madeBody().meshes[m].mesh, posed);
        range = {std::min(range.x, edges.x), std::max(range.y, edges.y)};
        std::vector<float> out(posed.size() / kOrganVertexStep, 0);
        parallelFor(out.size(), 256, [&](std::size_t i) {
          const vec3 p = posed[i * kOrganVertexStep];
          if (solid.winding(p) > 0) return;
          if (const auto place = solid.at(p, 0.1f)) out[i] = place->distance;
        });
        const float most = *std::max_element(out.begin(), out.end());
        if (most > farthest) farthest = most, which = madeBody().meshes[m].name;
      }
    }
    MESSAGE(clip.name << ": edges " << range.x << " to " << range.y << " of rest, " << 1e3f * farthest
                      << " mm out " << which);
    CHECK(farthest <= 0.001f);
    CHECK(range.x > 0.6f);
    CHECK(range.y < 1.4f);
  }
}
