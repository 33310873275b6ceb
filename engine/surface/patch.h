#pragma once
#include <span>
#include <vector>

#include "network/network.h"
#include "shared/patch.h"
#include "surface/fork_rings.h"
#include "surface/section.h"

// The source's own walls around forks (network/fork_patch.h), carried by the rings of their vessels.
//
// A ring moves what follows it by an affine map: the turn of the frame that the centres of the patch's first
// three rings span, then the least turn that brings the ring's outward direction where it is; sizes across
// the vessel follow the ring's radius. So neither the twist of a vessel's frames nor a bend elsewhere reaches
// the patch. A vertex takes the mean of its rings' maps by its weights. Between the patch's loop and the
// ring, which has as many vertices as its vessel's tube, lies a strip of triangles that is found anew in each
// pose, so that the surface is closed to the last bit. A patch whose rings a pose moves far against one
// another is smoothed (surface/patch_smooth.h).
namespace vasa {

struct PosedNetwork;

/// A network's patches as flat records, for the CPU and the shaders alike; constant over time.
struct PatchTable {
  struct Patch {
    std::uint32_t firstSeam = 0, seamCount = 0;
    /// Begins with a block of vertices (shared::kBlockVertices).
    std::uint32_t firstVertex = 0, vertexCount = 0;
    std::uint32_t firstTriangle = 0, triangleCount = 0;
    std::uint32_t vessel = 0;  ///< whose colour it takes: that of the trunk's first ring
    std::uint32_t span = 0;    ///< likewise, counted through all vessels
  };
  std::vector<Patch> patches;
  std::vector<shared::PatchSeam> seams;      ///< patch after patch
  std::vector<shared::SkinVertex> vertices;  ///< patch after patch; joints are seams
  std::vector<float> shares;                 ///< one a vertex, of those on loops
  std::vector<uvec3> triangles;              ///< of the patches, without strips
  std::vector<std::uint32_t> firstFan;       ///< one a vertex, and the end
  std::vector<shared::FanTriangle>
      fans;  ///< vertex after vertex; none of those that stay where their rings carry them
};

/// Gives every patch the nearest fork in the plan of its vessels, and takes that fork out of the plan. The
/// fork's rings move out to where the patch's are, if need be, and the tubes behind them become shorter.
/// Patches without such a fork, those whose tubes are too short, and those beyond the 65,536 rings that a
/// vertex can name, are left out.
PatchTable takePatches(const Network& network, ForkPlan& plan);

/// A seam in a pose.
struct PosedSeam {
  shared::JointRows joint;         ///< what moves the vertices that follow it
  std::vector<SurfacePoint> ring;  ///< the tube's own vertices there, bit for bit
  std::vector<uvec3> strip;        ///< vertices of the table; those of the ring from PatchSeam::vertex on
};
/// The CPU reference of shaders/patches.comp. @param around  m of the seam's vessel
PosedSeam poseSeam(const PosedNetwork& network, std::uint32_t seam, std::uint32_t around);

/// A patch's vertex in a pose before it is smoothed, the CPU reference of shaders/skin.comp. @param seams  of
/// the whole table
SurfacePoint poseVertex(const shared::SkinVertex& vertex, std::span<const shared::JointRows> seams);

/// Triangles of a seam's strip.
inline std::uint32_t stripTriangles(const shared::PatchSeam& seam, std::uint32_t around) {
  return seam.loopCount + around;
}

}  // namespace vasa
