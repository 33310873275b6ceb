#include "surface/surface_mesh.h"

#include <array>
#include <cassert>
#include <map>

#include "core/parallel.h"
#include "surface/fork.h"
#include "surface/fork_template.h"
#include "surface/patch_smooth.h"

// Rings are written by the tubes; forks and caps use the tubes' vertices. Where two forks share a ring
// without a tube between them, the ring is written by the first of them.
namespace vasa {
namespace {

class MeshLayout {
 public:
  MeshLayout(const PosedNetwork& network, const SweepShape& shape, std::span<const ForkSteps> fixed,
             SurfaceMesh& mesh)
      : network_(network), shape_(shape), fixed_(fixed), mesh_(mesh) {
    placeTubes();
    placeCaps();
    placeForks();
    placePatches();
    mesh.positions.resize(vertices_);
    mesh.normals.resize(vertices_);
    mesh.vesselOfVertex.resize(vertices_);
    mesh.triangles.resize(triangles_);
  }

  void write() {
    const SweepTable& table = network_.table;
    parallelFor(table.sweeps.size(), 16, [&](std::size_t i) { writeTube(std::uint32_t(i)); });
    parallelFor(table.caps.size(), 16, [&](std::size_t i) { writeCap(std::uint32_t(i)); });
    std::vector<std::vector<uvec3>> triangles(table.forks.size());
    parallelFor(table.forks.size(), 16, [&](std::size_t i) { triangles[i] = writeFork(std::uint32_t(i)); });
    for (const auto& of : triangles) mesh_.triangles.insert(mesh_.triangles.end(), of.begin(), of.end());
    writePatches();
  }

 private:
  struct Place {
    std::uint32_t vertex = 0, triangle = 0;
  };
  struct ForkPlace {
    struct Ring {
      std::uint32_t first = 0;  // its first vertex
      bool own = false;         // written by the fork
    };
    std::uint32_t vertex = 0;
    Ring a, b;
    std::array<Ring, shared::kMostBranches> branch;
  };
  using RingKey = std::pair<std::uint32_t, float>;  // first de Boor point of the span, t

  static RingKey keyOf(const shared::SweepRecord& sweep, bool last) {
    if (!last) return {sweep.point, sweep.from};
    if (sweep.to == 1 && sweep.nextClass != shared::kNoSpan) return {sweep.point + 1, 0.0f};
    return {sweep.point, sweep.to};
  }

  void placeTubes() {
    const auto& sweeps = network_.table.sweeps;
    for (std::uint32_t i = 0; i < sweeps.size(); ++i) {
      const bool follows = i > 0 && sweeps[i - 1].vessel == sweeps[i].vessel &&
                           keyOf(sweeps[i - 1], true) == keyOf(sweeps[i], false);
      if (follows) vertices_ -= shape_.around;
      tubes_.push_back({vertices_, triangles_});
      rings_[keyOf(sweeps[i], false)] = vertices_;
      vertices_ += shape_.sweepVertices();
      rings_[keyOf(sweeps[i], true)] = vertices_ - shape_.around;
      triangles_ += shape_.sweepTriangles();
    }
  }

  void placeCaps() {
    for (std::size_t i = 0; i < network_.table.caps.size(); ++i) {
      caps_.push_back({vertices_, triangles_});
      vertices_ += shape_.capVertices() - shape_.around;
      triangles_ += shape_.capTriangles();
    }
  }

  ForkPlace::Ring ringFor(const shared::ForkRing& ring) {
    const auto [place, isNew] = rings_.try_emplace(RingKey{ring.point, ring.t}, vertices_);
    if (isNew) vertices_ += shape_.around;
    return {place->second, isNew};
  }

  ForkShape shapeOf(const shared::ForkRecord& fork) const {
    return forkShape(network_.table, fork, [this](std::uint32_t) { return shape_.around; });
  }

  void placeForks() {
    const std::uint32_t m = shape_.around;
    for (const shared::ForkRecord& fork : network_.table.forks) {
      ForkPlace place;
      place.a = ringFor(fork.a);
      place.b = ringFor(fork.b);
      for (std::uint32_t i = 0; i < fork.branchCount; ++i)
        place.branch[i] = ringFor(network_.table.branches[fork.firstBranch + i].ring);
      place.vertex = vertices_;
      vertices_ += (shared::kTrunkRows - 2 + fork.branchCount * shared::kCollarRows) * m;
      forks_.push_back(place);
    }
  }

  void placePatches() {
    const PatchTable& table = network_.table.patches;
    for (const shared::PatchSeam& seam : table.seams) seams_.push_back(ringFor(seam.ring));
    patchVertices_.resize(table.vertices.size());
    for (const PatchTable::Patch& patch : table.patches)
      for (std::uint32_t i = 0; i < patch.vertexCount; ++i)
        patchVertices_[patch.firstVertex + i] = vertices_++;
  }

  void writePatches() {
    const PatchTable& table = network_.table.patches;
    std::vector<PosedSeam> posed(table.seams.size());
    parallelFor(posed.size(), 16,
                [&](std::size_t i) { posed[i] = poseSeam(network_, std::uint32_t(i), shape_.around); });
    std::vector<shared::JointRows> joints;
    for (const PosedSeam& seam : posed) joints.push_back(seam.joint);
    parallelFor(table.patches.size(), 4, [&](std::size_t i) {
      const PatchTable::Patch& patch = table.patches[i];
      const std::vector<SurfacePoint> points = posePatch(table, patch, joints);
      for (std::uint32_t k = 0; k < points.size(); ++k)
        put(patchVertices_[patch.firstVertex + k], points[k], patch.vessel);
    });
    for (const uvec3& t : table.triangles)
      mesh_.triangles.push_back({patchVertices_[t.x], patchVertices_[t.y], patchVertices_[t.z]});
    for (std::size_t i = 0; i < posed.size(); ++i) {
      const shared::PatchSeam& seam = table.seams[i];
      if (seams_[i].own)
        for (std::uint32_t k = 0; k < shape_.around; ++k)
          put(seams_[i].first + k, posed[i].ring[k], seam.vessel);
      const auto target = [&](std::uint32_t v) {
        return v >= seam.vertex ? seams_[i].first + v - seam.vertex : patchVertices_[v];
      };
      for (const uvec3& t : posed[i].strip)
        mesh_.triangles.push_back({target(t.x), target(t.y), target(t.z)});
    }
  }

  void put(std::uint32_t vertex, const SurfacePoint& point, std::uint32_t vessel) {
    mesh_.positions[vertex] = point.position;
    mesh_.normals[vertex] = point.normal;
    mesh_.vesselOfVertex[vertex] = vessel;
  }

  void writeTube(std::uint32_t index) {
    std::vector<SurfacePoint> points(shape_.sweepVertices());
    tessellateSweep(network_, index, shape_, points);
    const bool shared =
        index + 1 < tubes_.size() && tubes_[index + 1].vertex < tubes_[index].vertex + shape_.sweepVertices();
    // The next sweep writes its first ring.
    const std::size_t count = points.size() - (shared ? shape_.around : 0);
    for (std::uint32_t k = 0; k < count; ++k)
      put(tubes_[index].vertex + k, points[k], network_.table.vesselOfSweep[index]);
    std::uint32_t triangle = tubes_[index].triangle;
    for (const uvec3& t : sweepTriangles(shape_)) mesh_.triangles[triangle++] = t + tubes_[index].vertex;
  }

  void writeCap(std::uint32_t index) {
    const auto [sweep, last] = network_.table.caps[index];
    const std::uint32_t m = shape_.around;
    std::vector<SurfacePoint> points(shape_.capVertices());
    tessellateCap(network_, index, shape_, points);
    for (std::uint32_t k = m; k < points.size(); ++k)
      put(caps_[index].vertex + k - m, points[k], network_.table.vesselOfSweep[sweep]);
    const std::uint32_t rim = tubes_[sweep].vertex + (last ? shape_.along * m : 0);
    const auto target = [&, last = last](std::uint32_t k) {
      return k >= m ? caps_[index].vertex + k - m : rim + capDirection(k, m, last);
    };
    std::uint32_t triangle = caps_[index].triangle;
    for (const uvec3& t : capTriangles(shape_))
      mesh_.triangles[triangle++] = {target(t.x), target(t.y), target(t.z)};
  }

  // A stump's tip: a row of vertices in one place, one vertex here.
  static bool isTip(const ForkLayout& layout, std::uint32_t row) {
    if (row < shared::kTrunkRows) return layout.cut && (row == 2 || row == 3);
    const std::uint32_t branch = (row - shared::kTrunkRows) / kBranchRows;
    return layout.stump[branch] && row == branchRow(branch) - 2;
  }

  // Where a fork's vertex is in the mesh, and whether the fork writes it.
  std::pair<std::uint32_t, bool> targetOf(const ForkPlace& place, const ForkLayout& layout,
                                          std::uint32_t vertex) const {
    const std::uint32_t m = shape_.around, row = vertex / m;
    const std::uint32_t k = isTip(layout, row) ? 0 : vertex % m;
    if (row == 0) return {place.a.first + layout.a.direction(k, m), place.a.own};
    if (row < shared::kTrunkRows - 1) return {place.vertex + (row - 1) * m + k, true};
    if (row == shared::kTrunkRows - 1) return {place.b.first + layout.b.direction(k, m), place.b.own};
    const std::uint32_t branch = (row - shared::kTrunkRows) / kBranchRows;
    if (row == branchRow(branch))
      return {place.branch[branch].first + layout.branch[branch].direction(k, m), place.branch[branch].own};
    return {place.vertex + (row - 2 - branch) * m + k, true};
  }

  // A vessel's wall ends half way to the next one's ring, so that where both end in a ring of their own is
  // where they meet. A trunk of two vessels is divided in the middle of its holes, where the third comes in,
  // and the collar is the third's; that of a trunk of one is half the trunk's. A stump's tip is its own.
  std::uint32_t vesselAt(const shared::ForkRecord& fork, const ForkLayout& layout, std::uint32_t row) const {
    if (row < shared::kTrunkRows) return row <= shared::kTrunkRows / 2 ? fork.vesselA : fork.vesselB;
    const std::uint32_t branch = (row - shared::kTrunkRows) / kBranchRows;
    const bool isTrunks = fork.vesselA == fork.vesselB && !layout.stump[branch] &&
                          row <= holeRow(branch) + shared::kCollarRows / 2;
    return isTrunks ? fork.vesselA : network_.table.branches[fork.firstBranch + branch].vessel;
  }

  std::vector<uvec3> writeFork(std::uint32_t index) {
    const ForkPlace& place = forks_[index];
    const shared::ForkRecord& fork = network_.table.forks[index];
    const ForkShape shape = shapeOf(fork);
    std::vector<SurfacePoint> points(shape.vertices());
    const ForkLayout layout =
        evaluateFork(network_, fork, shape, points, fixed_.empty() ? nullptr : &fixed_[index]);
    for (std::uint32_t vertex = 0; vertex < points.size(); ++vertex) {
      const auto [target, own] = targetOf(place, layout, vertex);
      if (own) put(target, points[vertex], vesselAt(fork, layout, vertex / shape_.around));
    }
    // A triangle's vessel is that of its first vertex (SurfaceMesh): of the last row of the trunk that it
    // touches, else of a collar's.
    std::vector<uvec3> triangles =
        forkTriangles(shape, layout, fixed_.empty() ? points : std::span<const SurfacePoint>());
    const std::uint32_t trunkVertices = shared::kTrunkRows * shape_.around;
    const auto rank = [&](std::uint32_t v) { return v < trunkVertices ? v + points.size() : v; };
    for (uvec3& t : triangles) {
      if (rank(t.y) > rank(t.x) && rank(t.y) > rank(t.z)) t = {t.y, t.z, t.x};
      if (rank(t.z) > rank(t.x) && rank(t.z) > rank(t.y)) t = {t.z, t.x, t.y};
      t = {targetOf(place, layout, t.x).first, targetOf(place, layout, t.y).first,
           targetOf(place, layout, t.z).first};
    }
    return triangles;
  }

  const PosedNetwork& network_;
  SweepShape shape_;
  std::span<const ForkSteps> fixed_;
  SurfaceMesh& mesh_;
  std::uint32_t vertices_ = 0, triangles_ = 0;
  std::vector<Place> tubes_, caps_;
  std::vector<ForkPlace> forks_;
  std::vector<ForkPlace::Ring> seams_;        // of patches
  std::vector<std::uint32_t> patchVertices_;  // where those of the table are
  std::map<RingKey, std::uint32_t> rings_;
};

}  // namespace

SurfaceMesh surfaceMesh(const PosedNetwork& network, const SweepShape& shape,
                        std::span<const ForkSteps> fixed) {
  assert(shape.valid());
  SurfaceMesh mesh;
  MeshLayout(network, shape, fixed, mesh).write();
  return mesh;
}

SurfaceMesh surfaceMesh(const Network& network, std::span<const vec4> points,
                        std::span<const quat> knotFrames, const SweepShape& shape) {
  const SweepTable table = makeSweepTable(network);
  return surfaceMesh(PosedNetwork{table, points, knotFrames}, shape);
}

}  // namespace vasa
