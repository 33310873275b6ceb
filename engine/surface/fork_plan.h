#pragma once
#include <array>

#include "network/network.h"
#include "shared/fork.h"

namespace vasa {

struct ForkMemory;

/// A stretch of a vessel that keeps its own tube, in the vessel's parameter.
struct TubeStretch {
  std::uint32_t vessel = 0;
  float from = 0, to = 0;
  bool capFrom = false, capTo = false;  ///< ends of the tube that nothing carries on
};

/// How the ends of a network's vessels leave others: what planForks() has tried out.
struct ForkWays {
  static constexpr std::uint8_t kTube = 255;   ///< no fork: a tube of its own
  std::vector<std::uint8_t> of;                ///< two a vessel, that of its start first
  std::vector<std::array<VesselId, 2>> apart;  ///< would fold where one runs on into the other
};

/// How the surface of a network is cut into tubes and forks. Settled once, at rest: from then on a fork is a
/// function of its rings and of the branch's axis alone, so that its triangles stay what they are in every
/// pose.
///
/// A junction becomes one fork a branch: a piece of the host's course between two rings, whose wall opens
/// into a collar that ends in the branch's ring. A branch that leaves at a narrow angle does so where its
/// axis pierces the host's wall, not where the axes meet. Branches whose forks would overlap are moved apart
/// along the host. Two vessels joined end to end become a fork without a branch.
struct ForkPlan {
  std::vector<TubeStretch> tubes;  ///< vessel after vessel
  std::vector<shared::ForkRecord> forks;
  std::vector<shared::ForkBranch> branches;  ///< fork after fork
  std::vector<std::uint32_t> vesselOfFork;   ///< the host at ring a
  std::vector<std::uint32_t> steps;          ///< of smoothing that forks ask for at rest, as far as tried

  /// What became of the junctions.
  struct Report {
    std::uint32_t branches = 0;  ///< vessel ends that leave another vessel's side
    /// Vessels left out, as others run in the same place (surface/vessel_line.h).
    std::uint32_t doubles = 0;
    std::uint32_t joins = 0;    ///< vessels carried on into another, with or without a branch there
    std::uint32_t forked = 0;   ///< branches drawn as forks
    std::uint32_t leaning = 0;  ///< of these, branches whose ring does not stand clear of the host
    // Branches drawn as a tube of their own with a closed end inside the host, since they:
    std::uint32_t hidden = 0;    ///< never come out of it
    std::uint32_t tooShort = 0;  ///< would be used up by the forks at their two ends
    std::uint32_t crowded = 0;   ///< find no room between their neighbours on the host
    /// Would have a fork that folds, at rest, however far out its collar ends.
    std::uint32_t folded = 0;
  };
  Report report;
  ForkWays ways;
};
ForkPlan planForks(const Network& network);
/// The same plan, sooner where much of the network is as in those that were planned with this memory before.
ForkPlan planForks(const Network& network, ForkMemory& memory);

/// A plan for a network that will soon be replaced: all leaves as it did in an earlier plan, of a network
/// whose vessels were the same but for their shapes. Nothing is tried out, so that forks which have changed
/// may fold. Vessels that were appended since leave in the first way there is.
ForkPlan planForksAs(const Network& network, const ForkWays& before, ForkMemory& memory);

/// No forks: every vessel is a tube with two caps that ends inside its host. For comparison.
ForkPlan planWithoutForks(const Network& network);

}  // namespace vasa
