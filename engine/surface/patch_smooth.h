#pragma once
#include "surface/patch.h"

// Where a pose moves a patch's rings far against one another, the mean of their maps presses the wall
// together between them, and in the end folds it. There a vertex moves towards the middle of its neighbours,
// the more the smaller the least of its triangles has become, seen along its normal; and normals turn to
// those of the wall as it is. How much is a continuous function of the pose, and nothing where rings move
// little. Vertices on loops stay, so the surface stays closed. Not all is mended: a branch that its own
// vessel bends back within its radius stays inside out.
namespace vasa {

/// The triangles around each vertex that may be smoothed. Every other member of the table has to be there.
/// O(vertices).
void addFans(PatchTable& table);

/// How much of the smoothing a patch gets, in [0, 1]: none up to where its rings disagree by a radius
/// about each other's centres, all of it from twice that on. The CPU reference of shaders/patch_strain.comp.
/// @param seams  of the whole table, posed (PosedSeam::joint)
float patchSmoothing(const PatchTable& table, const PatchTable::Patch& patch,
                     std::span<const shared::JointRows> seams);

/// The CPU reference of shaders/patch_smooth.comp. @param vertices  the patch's, as poseVertex() gives them
void smoothPatch(const PatchTable& table, const PatchTable::Patch& patch, float share,
                 std::span<SurfacePoint> vertices);

/// All a patch's vertices in a pose, smoothed.
std::vector<SurfacePoint> posePatch(const PatchTable& table, const PatchTable::Patch& patch,
                                    std::span<const shared::JointRows> seams);

}  // namespace vasa
