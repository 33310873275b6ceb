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

constexpr float kHandleRadius = 7.5f;  ///< [pixels of an ordinary screen]

/// A grip of the mannequin, where it is in the window.
struct JointHandle {
  std::size_t grip;  ///< of Mannequin::grips()
  vec2 place;        ///< [pixels]
};
/// Of grips that would lie on one another only the nearest, one of the body before one of a hand.
/// @param scale  pixels for one of an ordinary screen
std::vector<JointHandle> jointHandles(const Mannequin& mannequin, const Pose& pose, const Camera& camera,
                                      const Rect& picture, float scale);

/// The handle that a press at a place takes hold of.
std::optional<JointHandle> handleAt(std::span<const JointHandle> handles, vec2 place, float scale);

/// Poses the body by pulling it about, in the plane through what is pulled that lies parallel to the picture:
/// a pulled wrist takes its whole arm along, within what joints can do (body/reach.h). A pulled pelvis moves
/// and takes the body along; it sinks over bending knees. Where it moves, or turns because a hip is pulled,
/// the feet stay where they are, as far as the legs reach: beyond that they leave the floor, but do not sink
/// into it. With Ctrl only the joint next to the handle turns, about the line of sight.
class PoseTool {
 public:
  /// @param scale  pixels for one of an ordinary screen
  explicit PoseTool(float scale = 1) : scale_(scale) {}

  /// Where the pointer is while it is somebody else's.
  void hover(vec2 place) { place_ = place; }
  /// @param single  Ctrl is held: one joint alone
  /// @return whether the event was a drag's: then it is nobody else's
  bool feed(const InputEvent& event, bool single, const Document& document, const PosedBody& body,
            const Camera& camera, const Rect& picture, ViewState& state);
  /// The grip that is held.
  std::optional<std::size_t> held() const { return held_ ? std::optional(held_->grip) : std::nullopt; }

 private:
  // A foot that stays while the pelvis moves or turns.
  struct Planted {
    std::size_t grip;
    vec3 at;      // [m]
    mat4 stands;  // the ankle
    std::vector<vec3> pressed, latest;
  };
  struct Held {
    std::size_t grip;
    bool single;
    vec2 off;                   // [pixels] from the pointer to the grip
    vec3 from;                  // [m] the grip when it was taken
    std::vector<vec3> pressed;  // angles since rest then
    std::vector<vec3> latest;
    std::vector<Planted> feet;
    vec3 moved{0};  // [m] the pelvis, when it was taken
  };
  static std::vector<Planted> plantedFeet(const Grip& pulled, const Document& document,
                                          const PosedBody& body);
  static float hold(Planted& foot, const Pose& clip, const Document& document, ViewState& state);
  void carry(vec3 way, const Pose& clip, const Document& document, ViewState& state);
  void take(const JointHandle& handle, bool single, const Document& document, const PosedBody& body,
            ViewState& state);
  void pull(vec2 to, const Document& document, const PosedBody& body, const Camera& camera,
            const Rect& picture, ViewState& state);
  void turn(vec2 to, const Document& document, const PosedBody& body, const Camera& camera,
            const Rect& picture, ViewState& state) const;

  float scale_;
  vec2 place_{0};
  std::optional<Held> held_;
};

/// The turn of a joint in the state, added where there is none yet.
JointTurn& turnOfJoint(ViewState& state, JointId joint, const JointMotion& motion);

/// While both sides are posed alike: the other side's joint follows.
void followOnOtherSide(const Mannequin& mannequin, ViewState& state, JointId joint);

}  // namespace vasa::viewer
