#pragma once
#include "body/binding.h"
#include "body/body.h"
#include "body/limb_clearance.h"
#include "body/sliding.h"
#include "network/network.h"
#include "scene/reading.h"
#include "scene/scene_file.h"

namespace vasa {

/// A body, the vessels in it, and how they hang on it. Constant over time.
struct Scene {
  Body body;
  Network network;  ///< all networks of the scene, merged
  Binding binding;
  std::vector<VesselHold> holds;  ///< where vessels are held in their beds, besides forks
};

/// The body alone; where the clip is a .bvh file, with that motion carried to it (body/retarget.h) among its
/// clips.
Result<Body> loadBody(const SceneFile& file);

/// Reads what a scene file names, converts vessels that are no .vasa file (scene/vessel_files.h), replays the
/// journals of edits (edit/replay.h) and binds what they make to the body. Fails as readers, conversion,
/// merging, editing and binding do; vessels that do not lie in the body are refused. Can be cancelled
/// (core/cancellation.h).
Result<Scene> loadScene(const SceneFile& file, const ReadingProgress& told = {});

/// The body's clip with this name, or the only one that begins with it. badInput lists what there is.
Result<const Clip*> findClip(const Body& body, std::string_view name);
/// The one that a scene names; null where it names none.
Result<const Clip*> clipOf(const Body& body, const SceneFile& file);

/// The clip that a scene file names; nullptr where it names none. Limbs that pass through the body are turned
/// out of it (body/limb_clearance.h), and what was done is told, unless the file asks for the motion as
/// recorded.
Result<const Clip*> sceneClip(Scene& scene, const SceneFile& file);

/// The same for all clips of a body. @return  the limbs that were, or that could not be
std::vector<ClearedLimb> clearLimbs(const SceneFile& file, const Body& body, std::span<Clip> clips);

/// "LeftArm lies up to 46 mm in the body in 80 frames, and is turned out of it by up to 6.4 degrees"
std::string describeLimb(const ClearedLimb& limb);

/// The part of the scene that a name means: a vessel or a joint. Upper and lower case are alike; a whole name
/// goes before a part of one, vessels before joints.
struct Subject {
  VesselId vessel;
  JointId joint;
  std::vector<std::string> others;  ///< that a part of a name means as well: of several the first is taken
};
Result<Subject> findSubject(const Scene& scene, std::string_view name);

/// Box of a subject in a pose: of the vessel's tubes, or a cube of a seventh of the body height around the
/// joint.
Aabb subjectBounds(const Scene& scene, const Subject& subject, const Pose& pose,
                   std::span<const vec4> points);

/// How far the body has moved over the floor since rest: the way of its first joint with several
/// children, without its height.
vec3 wayOverFloor(const Scene& scene, const Pose& pose);

/// Box that holds the body and its vessels in every frame of a clip (nullptr: at rest) seen by somebody who
/// goes along with it (wayOverFloor taken off), from the joints' motion and what stands out beyond the joints
/// at rest.
Aabb motionBounds(const Scene& scene, const Clip* clip);

}  // namespace vasa
