#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "collide/network_tubes.h"
#include "collide/sphere_tree.h"
#include "collide/tube_detector.h"
#include "core/cancellation.h"
#include "curve/bounds.h"
#include "paper_easel.h"
#include "scene/frame.h"

// Figure 6: the paper's hierarchy drawn. Of two tubes that come into each other's way in a pose: the spheres
// around them and their neighbours in the sphere tree, the spheres a level above, and the two's line-swept
// spheres as they are halved.
namespace vasa::cli {
namespace {

constexpr float kOpacity = 0.32f;

struct Shape {
  explicit Shape(const Network& network)
      : layout(network), points(network.points().begin(), network.points().end()), tubes(layout.count()) {
    layout.shape(points, tubes);
  }
  NetworkTubes layout;
  std::vector<vec4> points;
  std::vector<Bezier> tubes;
};

// A ball where the ends are one place.
TriangleMesh capsuleMesh(const Capsule& capsule) {
  constexpr std::uint32_t kBallAround = 48, kRings = 12;  // rings a half ball
  const vec3 along = capsule.b - capsule.a;
  const float length = glm::length(along);
  const vec3 axis = length > 0 ? along / length : vec3(0, 1, 0), u = anyPerpendicular(axis),
             v = glm::cross(axis, u);
  TriangleMesh mesh;
  for (std::uint32_t ring = 0; ring < 2 * kRings; ++ring) {
    const bool upper = ring >= kRings;
    const float latitude = kPi * (float(upper ? ring - 1 : ring) / float(2 * kRings - 2) - 0.5f);
    for (std::uint32_t k = 0; k < kBallAround; ++k) {
      const float longitude = 2 * kPi * float(k) / kBallAround;
      const vec3 out = std::cos(latitude) * (std::cos(longitude) * u + std::sin(longitude) * v) +
                       std::sin(latitude) * axis;
      mesh.positions.push_back((upper ? capsule.b : capsule.a) + capsule.radius * out);
    }
  }
  for (std::uint32_t ring = 0; ring + 1 < 2 * kRings; ++ring)
    for (std::uint32_t k = 0; k < kBallAround; ++k) {
      const std::uint32_t a = ring * kBallAround + k, b = ring * kBallAround + (k + 1) % kBallAround;
      mesh.triangles.push_back({a, b, b + kBallAround});
      mesh.triangles.push_back({a, b + kBallAround, a + kBallAround});
    }
  return mesh;
}

TriangleMesh ballMesh(const Sphere& sphere) {
  return capsuleMesh({sphere.centre, sphere.centre, sphere.radius});
}

// How much a tube bends, in radii: what its swept spheres show.
float bend(const Bezier& tube) {
  return filipBound(filipConstant(tube), 0) / std::max(radiusBound(tube), 1e-6f);
}

// The pair that shows most, of those that meet, or that come within 5 mm where none do.
std::optional<TubePair> choosePair(const Shape& shape) {
  constexpr float kNear = 0.005f;  // [m]
  TubeDetector detector(shape.tubes, shape.layout.neighbours());
  std::optional<TubePair> best;
  for (const float margin : {0.0f, kNear}) {
    detector.update(shape.tubes, margin);
    float most = 0;
    for (const TubePair& pair : detector.detect()) {
      const float shown = std::min(bend(shape.tubes[pair.i]), bend(shape.tubes[pair.j]));
      if (shown > most) most = shown, best = pair;
    }
    if (best) break;
  }
  return best;
}

std::uint32_t leafOf(const SphereTree& tree, std::uint32_t tube) {
  std::uint32_t leaf = 0;
  while (tree.tube(leaf) != tube) ++leaf;
  return leaf;
}

struct Volumes {
  std::string caption;
  std::vector<SkinnedMesh> meshes;
  std::vector<char> spans;  // of the tubes inside
  Report facts;
};

constexpr vec3 kFirst{0.95f, 0.62f, 0.20f}, kSecond{0.25f, 0.62f, 0.42f};

Volumes spheres(const Shape& shape, const SphereTree& tree, const TubePair& pair, std::uint32_t level,
                std::string caption) {
  Volumes volumes{std::move(caption), {}, std::vector<char>(shape.tubes.size(), 0), {}};
  std::vector<std::uint32_t> nodes;
  for (const std::uint32_t tube : {pair.i, pair.j}) nodes.push_back(leafOf(tree, tube) / SphereTree::kArity);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  for (const std::uint32_t node : nodes) {
    const vec3 colour = node == nodes.front() ? kFirst : kSecond;
    const std::uint32_t first = node * SphereTree::kArity,
                        end = std::min(tree.count(0), first + SphereTree::kArity);
    for (std::uint32_t leaf = first; leaf < end; ++leaf) {
      volumes.spans[tree.tube(leaf)] = 1;
      if (level == 0)
        volumes.meshes.push_back(stillMesh("sphere", ballMesh(tree.sphere(0, leaf)), colour, true));
    }
    if (level == 1)
      volumes.meshes.push_back(stillMesh("sphere", ballMesh(tree.sphere(1, node)), colour, true));
  }
  volumes.facts = {{"level", level}, {"spheres", volumes.meshes.size()}};
  return volumes;
}

Volumes sweptSpheres(const Shape& shape, const TubePair& pair, int level, std::string caption) {
  Volumes volumes{std::move(caption), {}, std::vector<char>(shape.tubes.size(), 0), {}};
  for (const std::uint32_t tube : {pair.i, pair.j}) {
    volumes.spans[tube] = 1;
    for (int piece = 0; piece < 1 << level; ++piece)
      volumes.meshes.push_back(stillMesh("swept sphere",
                                         capsuleMesh(pieceCapsule(shape.tubes[tube], level, piece)),
                                         tube == pair.i ? kFirst : kSecond, true));
  }
  volumes.facts = {{"level", level}, {"swept_spheres", volumes.meshes.size()}};
  return volumes;
}

Aabb boundsOf(std::span<const SkinnedMesh> meshes) {
  Aabb box;
  for (const SkinnedMesh& mesh : meshes) box.add(mesh.mesh.bounds());
  return box;
}

// Across both chords.
vec3 faceOn(const Shape& shape, const TubePair& pair) {
  const auto chord = [&](std::uint32_t tube) {
    return vec3(shape.tubes[tube].b[3]) - vec3(shape.tubes[tube].b[0]);
  };
  const vec3 normal = glm::cross(chord(pair.i), chord(pair.j));
  if (!(glm::length(normal) > 0)) return {0, 0, 1};
  return normal.z < 0 ? -normal : normal;
}

void pose(const PaperStudy& study, Shape& shape) {
  if (!study.clip) return;
  FrameMaker maker(study.scene);
  maker.make(study.clip, study.clip->timeOfFrame(study.clip->frameCount() / 3));
  shape.points.assign(maker.points().begin(), maker.points().end());
  shape.layout.shape(shape.points, shape.tubes);
}

}  // namespace

Result<PaperFigure> hierarchyFigure(const PaperStudy& study, gpu::Device& device) {
  PaperFigure figure{
      "Bounding volume hierarchy: (a), (b) spheres of two levels around sweep surfaces, (c) to (e) the line-swept spheres of one pair, halved.",
      {},
      Report::array(),
      {}};
  const Network& network = study.scene.network;
  Shape shape(network);
  SphereTree tree(shape.tubes);
  pose(study, shape);
  tree.refit(shape.tubes);
  const auto pair = choosePair(shape);
  if (!pair) {
    figure.note = "No two vessels of this network come near one another.";
    return figure;
  }
  const Volumes all[] = {
      spheres(shape, tree, *pair, 0, "(a) around each sweep"),
      spheres(shape, tree, *pair, 1, "(b) around eight"), sweptSpheres(shape, *pair, 0, "(c) whole"),
      sweptSpheres(shape, *pair, 1, "(d) halves"), sweptSpheres(shape, *pair, 2, "(e) quarters")};
  Look look = pageLook();
  look.otherOpacity = kOpacity;
  // Both pictures of spheres, and all of swept spheres, are of one size.
  const Aabb wide = boundsOf(all[1].meshes), close = boundsOf(all[2].meshes);
  for (const Volumes& volumes : all) {
    checkpoint();
    Easel easel(study, device,
                {.network = network, .table = &study.table, .points = shape.points, .meshes = volumes.meshes},
                {300, 340});
    easel.showOnly(volumes.spans);
    const bool isWide = &volumes < all + 2;
    figure.panels.push_back(
        {volumes.caption,
         easel.draw(cameraOn(isWide ? wide : close, faceOn(shape, *pair), easel.aspect()), look)});
    figure.facts.push_back(volumes.facts);
  }
  return figure;
}

}  // namespace vasa::cli
