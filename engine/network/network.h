#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/ids.h"
#include "core/result.h"
#include "curve/bspline.h"
#include "network/fork_patch.h"

namespace vasa {

enum class VesselKind : std::uint8_t { artery, vein, portalVein, lymphatic, other };
std::string_view kindName(VesselKind kind);  ///< "artery", "vein", "portal vein", "lymphatic", "other"

/// A named, unbranched run of spans: one clamped cubic B-spline (curve/bspline.h).
struct Vessel {
  std::string name;
  std::string ontologyId;  ///< e.g. "FMA50029"; empty where unknown
  VesselKind kind = VesselKind::other;
  std::uint32_t firstPoint = 0;  ///< into Network::points()
  std::uint32_t pointCount = 0;  ///< at least 4
  NodeId start, end;             ///< node at the first / last point; invalid where the end is free

  std::uint32_t spanCount() const { return pointCount - 3; }
  NodeId node(bool last) const { return last ? end : start; }
  float parameterOf(bool last) const { return last ? float(spanCount()) : 0; }
  /// Whether one of its points is pinned to a node.
  bool isPinned(std::uint32_t point) const {
    return (point == 0 && start.valid()) || (point + 1 == pointCount && end.valid());
  }
};

/// One end of a vessel that meets a node.
struct VesselEnd {
  VesselId vessel;
  bool last = false;  ///< false: the vessel's first point, true: its last
  bool operator==(const VesselEnd&) const = default;
};

/// The vessel that passes through a node, and where: a side branch leaves it there.
struct Host {
  VesselId vessel;
  float parameter = 0;  ///< u in [0, spans]
  bool operator==(const Host&) const = default;
};

/// A place that vessels share. With a host it lies on the host's centre line at host.parameter (a T);
/// without, it is the common end point of its ends (a Y, a crossing, or two vessels joined end to end). Every
/// incident end's de Boor end point *is* the node.
struct Node {
  std::optional<Host> host;
  std::uint32_t firstEnd = 0;  ///< into the network's table of ends
  std::uint32_t endCount = 0;

  /// Vessel arms that meet here: a passing vessel counts twice.
  std::uint32_t valence() const { return endCount + (host ? 2u : 0u); }
};

/// A network of vessels at rest: immutable topology and flat arrays. Made by NetworkBuilder or read from a
/// file. A deformed network is another array of points of the same length.
class Network {
 public:
  std::span<const Vessel> vessels() const { return vessels_; }
  std::span<const Node> nodes() const { return nodes_; }
  const Vessel& vessel(VesselId id) const { return vessels_[id.value]; }
  const Node& node(NodeId id) const { return nodes_[id.value]; }
  std::span<const VesselEnd> ends(const Node& node) const {
    return std::span(ends_).subspan(node.firstEnd, node.endCount);
  }

  /// Which of points() a vessel's end is.
  std::uint32_t pointOf(const VesselEnd& end) const {
    const Vessel& own = vessel(end.vessel);
    return own.firstPoint + (end.last ? own.pointCount - 1 : 0);
  }

  /// De Boor points (x, y, z, r) [m] of all vessels, vessel after vessel, at rest.
  std::span<const vec4> points() const { return points_; }
  std::span<const vec4> pointsOf(const Vessel& vessel) const { return pointsOf(vessel, points_); }
  /// The same vessel's part of another array of the network's points (a posed network).
  template <class T>
  static std::span<T> pointsOf(const Vessel& vessel, std::span<T> points) {
    return points.subspan(vessel.firstPoint, vessel.pointCount);
  }
  static std::span<const vec4> pointsOf(const Vessel& vessel, const std::vector<vec4>& points) {
    return std::span(points).subspan(vessel.firstPoint, vessel.pointCount);
  }

  std::uint32_t sweepCount() const;     ///< spans of all vessels
  std::uint32_t sectionCount() const;   ///< spans + 1 of each vessel
  std::uint32_t junctionCount() const;  ///< nodes of valence 3 and more
  /// Connected parts, through nodes.
  std::uint32_t componentCount() const;
  /// The part each vessel belongs to, numbered by first appearance.
  std::vector<std::uint32_t> components() const;

  /// Walls of the source around some of its forks (network/fork_patch.h); none where none were kept.
  std::span<const ForkPatch> patches() const { return patches_; }

  /// Height of the body that the network belongs to [m]: the unit of the paper's tolerances.
  float bodyHeight() const { return bodyHeight_; }

  /// Nodes in an order in which every host is settled before the ends that hang on it.
  std::span<const NodeId> pinOrder() const { return pinOrder_; }

 private:
  friend class NetworkBuilder;
  friend Result<Network> withPatches(Network network, std::vector<ForkPatch> patches);
  std::vector<Vessel> vessels_;
  std::vector<Node> nodes_;
  std::vector<VesselEnd> ends_;
  std::vector<vec4> points_;
  std::vector<NodeId> pinOrder_;
  std::vector<ForkPatch> patches_;
  float bodyHeight_ = 1;
};

/// The network with these patches instead of its own. Fails with badInput that numbers the patch and says
/// what is wrong with it (patchFault).
Result<Network> withPatches(Network network, std::vector<ForkPatch> patches);

/// Puts every vessel end exactly onto its node, position only, after points were moved: onto the host's
/// centre line, or onto the first of the node's ends. @param points  as Network::points(). O(ends).
void pinEnds(const Network& network, std::span<vec4> points);

}  // namespace vasa
