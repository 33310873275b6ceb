#pragma once
#include <memory>

#include "avoid/bones.h"
#include "avoid/certificate.h"
#include "avoid/lumen.h"
#include "avoid/posed_vessels.h"
#include "body/body.h"
#include "body/volume.h"

namespace vasa {

/// Fixed budgets: no frame takes more than these, once, again at each of eight resorts where there is no room, and up to
/// three times more for vessels on the wrong side of one another, and half of them up to five times for those in bones,
/// of which each may then have some detours looked for.
struct AvoidOptions {
  float bending = 30;        ///< β of the metric: how smooth a correction is along a vessel
  unsigned rounds = 10;      ///< detections, each followed by sweeps
  unsigned sweeps = 40;      ///< of dual ascent over all constraints, a round
  unsigned lumenRounds = 8;  ///< of making vessels thinner where there is no room
  bool skinWall = false;     ///< hold vessels below the skin, too
};

/// Tubes in bones or the heart.
struct BoneReport {
  std::uint32_t contacts = 0;  ///< in a bone that they were not in at rest
  std::uint32_t deeper = 0;    ///< deeper in one that they were in at rest
  float depth = 0;             ///< [m] the deepest of both, from where they may be
};

/// What was done for a frame.
struct AvoidReport {
  Certificate before, after;
  BoneReport bones, bonesAfter;
  std::uint32_t skinContacts = 0, skinContactsAfter = 0;  ///< tubes nearer to the skin than they may be, with skinWall
  std::uint32_t constraints = 0;  ///< in the pool at the end
  std::uint32_t rounds = 0;       ///< detections that asked for a correction
  float movedMax = 0, movedRms = 0;  ///< [m] of de Boor points, by the correction
  std::uint32_t sidesChanged = 0;      ///< pairs of tubes on the wrong side of one another, before
  std::uint32_t sidesChangedAfter = 0; ///< ... and after
  VolumeKeeper::Outcome volume;        ///< after the last change of radii
  std::uint32_t narrowSpans = 0;     ///< spans whose lumen gave way
  float leastLumen = 1;              ///< the thinnest of them, by the radius at rest
  double detectMs = 0, boneMs = 0, solveMs = 0;  ///< over all rounds; bones are looked at apart
  double certifyMs = 0;                          ///< the last look, which is the certificate
};

/// Moves vessels apart that run through one another in a pose: the nearest admissible shape,
///   least ½ zᵀ W z  subject to  n_c · (C_i(s_c) - C_j(t_c)) >= d_c  for every contact c,
/// with z and W as in avoid/motion_space.h, so that branches stay joined. Method: dual coordinate ascent (Hildreth 1957)
/// over a pool of contacts that is detected anew each round and only grows, 0 <= multipliers <= a limit, so that what
/// cannot be met does not fling vessels about; then, where there is no room, thinner vessels. Where vessels are in one
/// another's way even so, what was asked for between them is forgotten, on which sides they belong too, and in the end
/// bones let them through; what is in a bone after all is led around it (avoid/detour.h). The certificate by an exact
/// query, which comes last, goes before all else. Budgets are fixed and the order is that of the pairs: the result depends
/// on the scene and the pose alone.
class Avoider {
 public:
  /// @param network  must outlive this
  /// @param body     whose bones and heart vessels must not enter, and whose skin they keep below; or null. Read, not kept
  explicit Avoider(const Network& network, const Body* body = nullptr, AvoidOptions options = {});
  ~Avoider();
  Avoider(Avoider&&) noexcept;

  /// @param posed   the posed network, before any correction
  /// @param volume  keeps the vessels' volume while they are moved, or null
  /// @param points  caller-owned; on entry posed.points with the radii they are to have, on return the result
  AvoidReport run(const PosedVessels& posed, const VolumeKeeper* volume, std::span<vec4> points);

  /// Of the last run: where vessels interfere in spite of all, and where they gave way.
  std::span<const Interference::Place> remaining() const;
  std::span<const NarrowPlace> narrowed() const;
  /// Of the last run: tubes that are on the wrong side of one another in spite of all (RestSides::findChanged).
  std::span<const Contact> changedSides() const;
  /// Of the last run: places of tubes that are in a bone or the heart in spite of all, deeper than at rest.
  std::span<const BoneContact> inBones() const;
  JointId jointOfBone(std::uint32_t part) const;
  /// Of the last run: where vessels interfered before.
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
