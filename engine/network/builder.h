#pragma once
#include <map>

#include "core/result.h"
#include "network/network.h"

namespace vasa {

/// Ends that may meet in one place, or on one vessel's side within its radius. Each is the neighbour of every
/// other, so that what detection keeps grows with the square; a confluence of living vessels has under ten,
/// the soma of a traced cell under a hundred.
inline constexpr std::size_t kMostEndsAtNode = 256;

/// Collects vessels and the nodes they share, then builds the immutable network.
///
///   NetworkBuilder builder;
///   VesselId aorta = builder.addVessel({"aorta", "FMA3734", VesselKind::artery}, aortaPoints);
///   VesselId renal = builder.addVessel({"left renal artery", "", VesselKind::artery}, renalPoints);
///   builder.joinToSide({renal, false}, {aorta, 7.4f});
///   Result<Network> network = builder.build(1.75f);
class NetworkBuilder {
 public:
  struct Label {
    std::string name;
    std::string ontologyId = {};
    VesselKind kind = VesselKind::other;
  };

  /// @param points  de Boor points (x, y, z, r) [m], at least 4
  VesselId addVessel(Label label, std::vector<vec4> points);

  /// A node that these ends share (a Y; a crossing; two ends joined into one line). The place is the first
  /// end's.
  NodeId joinEnds(std::vector<VesselEnd> ends);

  /// A node on the side of `host`, with one end on it. Returns the existing node if that place has one
  /// already (equal parameter). An end may belong to one node only.
  NodeId joinToSide(VesselEnd end, Host host);

  /// A node with a host, or without one, and all its ends at once: what a reader of files has.
  NodeId addNode(std::optional<Host> host, std::vector<VesselEnd> ends);

  /// Adds one more end to a node.
  void addEnd(NodeId node, VesselEnd end);

  std::size_t vesselCount() const { return labels_.size(); }
  const std::vector<vec4>& pointsOf(VesselId vessel) const { return points_[vessel.value]; }

  /// Checks everything and moves the ends exactly onto their nodes.
  /// Fails with badInput that names the vessel: fewer than 4 points, a value that is not finite, a radius
  /// that is not positive, a length of zero, an end in two nodes, a host parameter outside the vessel, an end
  /// that hangs on its own vessel, hosts that depend on one another in a circle, an end more than 5 % of the
  /// body height from its node, a place or a radius of a vessel where more than kMostEndsAtNode ends meet.
  /// @param bodyHeight  [m] > 0
  Result<Network> build(float bodyHeight) const;

 private:
  struct PendingNode {
    std::optional<Host> host;
    std::vector<VesselEnd> ends;
  };
  std::vector<Label> labels_;
  std::vector<std::vector<vec4>> points_;
  std::vector<PendingNode> nodes_;
  std::map<std::uint64_t, std::uint32_t> hosted_;  // the first node of each host, by both its parts
};

}  // namespace vasa
