#pragma once
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "avoid/certificate.h"
#include "avoid/correction.h"
#include "avoid/lumen.h"
#include "body/body.h"
#include "body/volume.h"
#include "solids/bones.h"

namespace vasa {

/// Before the correction: where everything was, at rest and in the pose.
struct PosedVessels {
  std::span<const vec4> points;     ///< as Network::points(), in the pose
  std::span<const quat> rotations;  ///< how each point's surroundings turned since rest (Deformer::rotations)
  std::span<const mat4> jointMatrices = {};  ///< a joint's world · inverseBind; may be empty without bones
};

/// Fixed budgets: no step takes more than these.
struct AvoidOptions {
  float bending = 30;     ///< β of the metric: how smooth a correction is along a vessel
  unsigned rounds = 8;    ///< detections, each followed by sweeps; then as many, by giving way; 0: only look
  unsigned sweeps = 30;   ///< of dual ascent over all constraints, a round
  bool skinWall = false;  ///< hold vessels below the skin, too
};

/// Tubes in bones or the heart.
struct BoneReport {
  std::uint32_t contacts = 0;  ///< in a bone that they were not in at rest
  std::uint32_t deeper = 0;    ///< deeper in one that they were in at rest
  float depth = 0;             ///< [m] the deepest of both, from where they may be
};

/// What is in what's way in a shape.
struct PosedLook {
  Certificate vessels;
  BoneReport bones;
  std::uint32_t skinContacts = 0;  ///< tubes nearer to the skin than they may be, with skinWall
};

/// What was done for a frame.
struct AvoidReport {
  Certificate after;
  BoneReport bonesAfter;
  std::uint32_t skinContactsAfter = 0;
  std::uint32_t constraints = 0;     ///< in the pool at the end
  std::uint32_t rounds = 0;          ///< detections that asked for a correction, also in steps not made
  float movedMax = 0, movedRms = 0;  ///< [m] of de Boor points, by the correction
  VolumeKeeper::Outcome volume;      ///< after the last change of radii
  std::uint32_t narrowSpans = 0;     ///< spans whose lumen gave way
  float leastLumen = 1;              ///< the thinnest of them, by the radius at rest
  double detectMs = 0, boneMs = 0, solveMs = 0;  ///< over all rounds; bones are looked at apart
  double certifyMs = 0;                          ///< the last look, which is the certificate
  /// Of a frame that took several steps.
  void addTimes(const AvoidReport& earlier);
};

/// How a pose is reached from the one before.
struct Stride {
  float seconds = 0;  ///< since then
  /// False: where it would be a guess on which side of one another something comes to lie, or something is
  /// left in something's way, it is not made.
  bool atAnyLength = false;
  bool isLast = false;  ///< the result is shown: it is certified by a query of its own
  /// The pose is that of start(), whose correction is only made admissible: nothing fades or is turned back.
  bool inPlace = false;
};

/// Moves vessels apart that a motion brings into one another's way, and out of bones: by continuation. Each
/// step starts from the last one's correction, which fades to a third in a second, and finds the nearest
/// admissible shape,
///   least ½ (z - z0)ᵀ W (z - z0)  subject to  n_c · (C_i(s_c) - C_j(t_c)) >= d_c  for every contact c,
/// with z0 the faded correction and W as in avoid/motion_space.h, so that branches stay joined. Contacts lie
/// on the side on which the last admissible shape had them, so that no vessel passes through another. Method:
/// dual coordinate ascent (Hildreth 1957) over a pool of contacts that only grows: each round looks for more
/// where something moved. A step that may be refused is, where that leaves something in something's way;
/// else, where there is no room, vessels become thinner, and what is caught starts anew from the pose. The
/// certificate by an exact query comes last. Budgets are fixed and the order is that of the pairs: a step
/// depends on the correction before and the two poses alone.
class Avoider {
 public:
  /// @param network  must outlive this
  /// @param body     whose bones and heart vessels must not enter, and whose skin they keep below; or null.
  /// Read, not kept
  explicit Avoider(const Network& network, const Body* body = nullptr, AvoidOptions options = {});
  ~Avoider();
  Avoider(Avoider&&) noexcept;

  /// Takes a pose with a correction that it was given before, as the place to go on from; or without any,
  /// which is right at rest. @param points  caller-owned, the network with the correction on return
  AvoidReport start(const Correction& correction, const PosedVessels& posed, const VolumeKeeper* volume,
                    std::span<vec4> points);

  /// On to the next pose.
  /// @param posed    the posed network, before any correction
  /// @param volume   keeps the vessels' volume while they are moved, or null
  /// @param points   caller-owned; the result on return
  /// @return nothing if the step was not made, which leaves everything as it was but for the times that the
  /// next report tells
  std::optional<AvoidReport> step(const PosedVessels& posed, const VolumeKeeper* volume, const Stride& stride,
                                  std::span<vec4> points);

  /// Looks at a shape, as a pose without any correction, and does nothing about it.
  PosedLook look(const PosedVessels& posed, std::span<const vec4> points);

  /// Of the last step.
  const Correction& correction() const;

  /// Of the last step: where vessels interfere in spite of all, and where they gave way.
  std::span<const Interference::Place> remaining() const;
  std::span<const NarrowPlace> narrowed() const;
  /// Of the last step: places of tubes that are in a bone or the heart in spite of all, deeper than at rest.
  std::span<const BoneContact> inBones() const;
  JointId jointOfBone(std::uint32_t part) const;
  /// Of the last look(): where vessels interfere.
  std::span<const Interference::Place> found() const;

  const NetworkTubes& layout() const;
  /// Pairs of tubes that overlap at rest.
  std::size_t restPairCount() const;
  /// Tubes that lie in a bone or the heart at rest.
  std::size_t restBoneContactCount() const;
  /// Pairs of tubes that are never looked at, for they are near one another along the network.
  std::size_t neighbourCount() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vasa
