#pragma once
#include <optional>
#include <span>
#include <vector>

#include "render/camera.h"
#include "viewer/document.h"
#include "viewer/input.h"
#include "viewer/layout.h"
#include "viewer/pose_worker.h"
#include "viewer/view_state.h"

namespace vasa::viewer {

/// A joint that can be dragged, where it is in the window [pixels]. Dragging it turns the joint it hangs on.
struct JointHandle {
  JointId joint;
  vec2 place;
};
/// Of joints that would lie on one another only the one nearest to the root.
/// @param scale  pixels for one of an ordinary screen
std::vector<JointHandle> jointHandles(const Skeleton& skeleton, const Pose& pose, const Camera& camera,
                                      const Rect& picture, float scale);

/// The handle that a press at a place takes hold of.
std::optional<JointHandle> handleAt(std::span<const JointHandle> handles, vec2 place, float scale);

/// Poses the body by dragging its joints, in the plane of the picture.
class PoseTool {
 public:
  /// @param scale  pixels for one of an ordinary screen
  explicit PoseTool(float scale = 1) : scale_(scale) {}

  /// Where the pointer is while it is somebody else's.
  void hover(vec2 place) { place_ = place; }
  /// @return whether the event was a drag's: then it is nobody else's
  bool feed(const InputEvent& event, const Document& document, const PosedBody& body, const Camera& camera,
            const Rect& picture, ViewState& state);
  std::optional<JointId> held() const { return held_; }

 private:
  void drag(vec2 to, const Document& document, const PosedBody& body, const Camera& camera,
            const Rect& picture, ViewState& state);

  float scale_;
  vec2 place_{0};
  std::optional<JointId> held_;
};

/// What each joint of a skeleton may do.
std::vector<JointMotion> jointMotions(const Skeleton& skeleton);

/// The turn of a joint in the state, added where there is none yet.
JointTurn& turnOfJoint(ViewState& state, JointId joint, const JointMotion& motion);

}  // namespace vasa::viewer
