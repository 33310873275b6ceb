#include <cmath>

#include "network/file.h"
#include "paper_study.h"

// Table I: what the network takes as sweeps and as the mesh that they stand for.
namespace vasa::cli {
namespace {

constexpr std::uint32_t kAround = 8;  // vertices a section: the paper's model has as many

// Of arteries, veins (portal ones, too) and everything.
struct ByKind {
  std::size_t artery = 0, vein = 0, total = 0;

  void add(VesselKind kind, std::size_t count) {
    if (kind == VesselKind::artery) artery += count;
    if (kind == VesselKind::vein || kind == VesselKind::portalVein) vein += count;
    total += count;
  }
  Report json() const { return {{"artery", artery}, {"vein", vein}, {"total", total}}; }
  ByKind times(std::size_t factor) const { return {factor * artery, factor * vein, factor * total}; }
};

Report row(const char* what, Report ours, Report paper) {
  return {{"what", what}, {"ours", std::move(ours)}, {"paper", std::move(paper)}};
}

TriangleMesh ringMesh(std::span<const vec4> points) {
  const std::uint32_t rings = spanCount(points) + 1;
  std::vector<quat> frames(rings);
  knotFrames(points, anyPerpendicular(unitTangent(points, 0)), frames);
  TriangleMesh mesh;
  for (std::uint32_t ring = 0; ring < rings; ++ring) {
    const vec4 centre = evaluate(points, float(ring));
    for (std::uint32_t k = 0; k < kAround; ++k) {
      const float angle = 2 * kPi * float(k) / kAround;
      mesh.positions.push_back(vec3(centre) +
                               frames[ring] * (centre.w * vec3(std::cos(angle), std::sin(angle), 0)));
    }
  }
  for (std::uint32_t ring = 0; ring + 1 < rings; ++ring)
    for (std::uint32_t k = 0; k < kAround; ++k) {
      const std::uint32_t a = ring * kAround + k, b = ring * kAround + (k + 1) % kAround;
      mesh.triangles.push_back({a, b, b + kAround});
      mesh.triangles.push_back({a, b + kAround, a + kAround});
    }
  return mesh;
}

}  // namespace

std::vector<SourceElement> meshesOf(const Network& network) {
  std::vector<SourceElement> elements;
  for (const Vessel& vessel : network.vessels())
    elements.push_back(
        {{vessel.name, {}, vessel.ontologyId, ringMesh(network.pointsOf(vessel))}, vessel.kind, vessel.name});
  return elements;
}

Report storageTable(const PaperStudy& study) {
  const Network& network = study.scene.network;
  ByKind vertices, triangles, meshBytes, sweeps, points;
  for (const SourceElement& source : study.meshes) {
    const TriangleMesh& mesh = source.element.mesh;
    vertices.add(source.kind, mesh.positions.size());
    triangles.add(source.kind, mesh.triangles.size());
    meshBytes.add(source.kind, mesh.bytes());
  }
  for (const Vessel& vessel : network.vessels()) {
    sweeps.add(vessel.kind, vessel.spanCount());
    points.add(vessel.kind, vessel.pointCount);
  }
  const std::size_t file = encodeNetwork(network, {.quantise = true}).size();
  Report rows = Report::array();
  rows.push_back(
      row("mesh: vertices", vertices.json(), {{"artery", 16344}, {"vein", 16548}, {"total", 32892}}));
  rows.push_back(
      row("mesh: triangles", triangles.json(), {{"artery", 30334}, {"vein", 30312}, {"total", 60646}}));
  rows.push_back(
      row("mesh: bytes", meshBytes.json(), {{"artery", 560'000}, {"vein", 562'000}, {"total", 1'120'000}}));
  rows.push_back(row("sweeps", sweeps.json(), {{"total", 4030}}));
  rows.push_back(row("sweeps: bytes, (x, y, z, r) of 32 bits each", points.times(sizeof(vec4)).json(),
                     {{"total", 84'000}}));
  rows.push_back(row("sweeps: bytes of the file, of 16 bits each, names and forks included",
                     {{"total", file}}, {{"total", 84'000}}));
  rows.push_back(
      row("mesh : file", {{"total", double(meshBytes.total) / double(file)}}, {{"total", 1120.0 / 84.0}}));
  rows.push_back(row("binding: bytes", {{"total", study.scene.binding.bytes()}}, {{"total", 66'000}}));
  return rows;
}

}  // namespace vasa::cli
