#include "paper_easel.h"

#include "render/picture.h"

namespace vasa::cli {
namespace {

// Stills are seen closely: every pixel is drawn as nine, or as one where it has to be quick.
RenderOptions renderOptions(const PaperStudy& study, const Easel::Subject& subject, PictureSize size) {
  return {.width = size.width,
          .height = size.height,
          .shape = {16, 10},
          .table = subject.table,
          .supersample = study.quick ? 1u : 3u,
          .occlusion = true,
          .growth = subject.growth,
          .capillaries = {.levels = subject.capillaryLevels},
          .seed = study.seed,
          .timed = false};
}

}  // namespace

Easel::Easel(const PaperStudy& study, gpu::Device& device, const Subject& subject, PictureSize size)
    : network_(subject.network),
      size_{study.pixels(size.width), study.pixels(size.height)},
      points_(subject.points.begin(), subject.points.end()),
      renderer_(device, subject.network, subject.meshes, renderOptions(study, subject, size_)) {
  if (points_.empty()) points_.assign(network_.points().begin(), network_.points().end());
  frames_.resize(network_.sweepCount() + network_.vessels().size());
  networkFrames(network_, points_, restReferences(network_), frames_);
}

void Easel::showOnly(std::span<const char> spans) {
  colours_.clear();
  std::size_t span = 0;
  for (const Vessel& vessel : network_.vessels())
    for (std::uint32_t s = 0; s < vessel.spanCount() && !spans.empty(); ++s, ++span)
      colours_.push_back(packColour(vec4(vec3(colourOf(vessel.kind)), spans[span] ? 1 : 0)));
  renderer_.setSweepColours(colours_);
}

Image Easel::draw(const Camera& camera, const Look& look) {
  const mat4 still(1);
  renderer_.draw({.points = points_,
                  .knotFrames = frames_,
                  .jointMatrices = {&still, 1},
                  .camera = camera,
                  .look = look});
  return renderer_.readBack();
}

Look pageLook() {
  Look look = lookNamed("atlas").value_or(Look{});
  look.background = vec4(1);
  return look;
}

Camera cameraOn(const Aabb& box, vec3 direction, float aspect) {
  constexpr float kAngle = 0.35f;  // [rad] about that of a portrait lens: little perspective
  const vec3 up = std::abs(glm::normalize(direction).y) > 0.95f ? vec3(0, 0, 1) : vec3(0, 1, 0);
  return focusOn(
      {.position = box.centre() + direction, .target = box.centre(), .up = up, .verticalAngle = kAngle}, box,
      aspect);
}

Aabb boundsOf(const Network& network, std::span<const char> spans) {
  Aabb box;
  std::size_t span = 0;
  for (const Vessel& vessel : network.vessels())
    for (std::uint32_t s = 0; s < vessel.spanCount(); ++s, ++span)
      if (spans[span]) box.add(bezierOfSpan(network.pointsOf(vessel), s).bounds());
  return box;
}

SkinnedMesh stillMesh(std::string name, TriangleMesh mesh, vec3 colour, bool smooth) {
  if (!smooth) {
    TriangleMesh facets;
    for (const uvec3& t : mesh.triangles) {
      const auto first = std::uint32_t(facets.positions.size());
      for (int k = 0; k < 3; ++k) facets.positions.push_back(mesh.positions[t[k]]);
      facets.triangles.push_back({first, first + 1, first + 2});
    }
    mesh = std::move(facets);
  }
  SkinnedMesh still;
  still.name = std::move(name);
  still.normals = vertexNormals(mesh);
  still.influences.assign(mesh.positions.size(), {.weights = {1, 0, 0, 0}});
  still.mesh = std::move(mesh);
  still.colour = linearColour(vec4(colour, 1));
  return still;
}

}  // namespace vasa::cli
