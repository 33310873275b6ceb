#pragma once
#include <optional>
#include <string_view>
#include <vector>

#include "scene/frame.h"

namespace vasa::plate {

/// What a page shows of a scene, and how one looks at it.
struct PlateSubject {
  std::string title, subtitle;
  std::vector<SkinnedMesh> meshes;  ///< the body's, without what belongs to other parts of it
  std::vector<char> vessels;        ///< one a vessel: whether it is drawn
  std::vector<char> own;            ///< one a vessel: whether a good part of it lies in what the page is of
  std::vector<vec3> framed;         ///< places of the pose that the picture has to hold
  vec3 towards{0, 0, 1};            ///< to the viewer
  vec3 up{0, 1, 0};
  mat3 turn{1};             ///< facing() of the body: a view's directions are a body's that faces +Z
  bool axial = false;       ///< up is a limb's axis, from wherever one looks
  std::optional<vec4> cut;  ///< Camera::cut
};

/// Turns +Z to where a body's front is at rest, about the vertical: by its trunk and the sides of its limbs.
/// Nothing where these are not known, or where the front is within 30 degrees of +Z.
mat3 facing(const Skeleton& skeleton);

/// Of each of a mesh's vertices the joint that moves it most.
std::vector<std::uint16_t> mainJoints(const Body& body, const SkinnedMesh& mesh);

/// Fails with usage that lists the pages for a name that is none of theirs: front, back, head, brain, thorax,
/// abdomen, arm, hand, leg, foot.
Result<void> checkPlateName(std::string_view name);

/// A page's subject. Of a limb the one on `side` (-1 right, 1 left) is shown, its axis upright, without the
/// rest of the body; a vessel is drawn whole where some of it lies in what is drawn.
/// Fails as checkPlateName() does, with badInput where the body's parts are not known (atlas::RegionFinder)
/// or there are none of those; for the brain's where no bones go with the head.
Result<PlateSubject> plateSubject(const Scene& scene, const FrameMaker& frame, std::string_view name,
                                  int side);

}  // namespace vasa::plate
